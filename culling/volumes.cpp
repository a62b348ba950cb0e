#include "culling/volumes.h"

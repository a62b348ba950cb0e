#include "culling/frustum.h"

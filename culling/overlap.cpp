#include "culling/overlap.h"

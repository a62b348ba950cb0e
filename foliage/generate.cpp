#include "foliage/generate.h"

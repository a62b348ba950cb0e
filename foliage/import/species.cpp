#include "foliage/import/species.h"

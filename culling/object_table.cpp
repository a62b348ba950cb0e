#include "culling/object_table.h"

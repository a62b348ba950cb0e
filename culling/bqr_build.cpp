#include "culling/bqr_tree.h"

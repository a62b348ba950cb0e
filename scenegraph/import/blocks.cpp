#include "scenegraph/import/blocks.h"

#include "scenegraph/visible.h"

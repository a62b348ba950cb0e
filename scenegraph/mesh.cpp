#include "scenegraph/mesh.h"

#include "scenegraph/import/meshes.h"

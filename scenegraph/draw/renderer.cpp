#include "scenegraph/draw/renderer.h"

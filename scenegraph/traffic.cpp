#include "scenegraph/traffic.h"

#include "scenegraph/import/build_traffic.h"

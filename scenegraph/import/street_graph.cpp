#include "scenegraph/import/street_graph.h"

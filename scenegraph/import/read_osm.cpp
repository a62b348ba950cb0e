#include "scenegraph/import/import.h"

#include "scenegraph/local_frame.h"

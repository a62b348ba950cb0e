#include "gl/handle.h"

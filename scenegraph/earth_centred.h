#pragma once
/// From a scene's frame to earth-centred coordinates, for hosts and formats that have those.
#include "scenegraph/local_frame.h"

namespace manzana {

/// From L to earth-centred, earth-fixed coordinates of WGS 84, metres.
Mat4d local_to_ecef(const LocalFrame& frame);

}  // namespace manzana

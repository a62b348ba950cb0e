#pragma once
/// Camera paths that fit any city, made from what its scene holds.
///   CameraPath path = builtin_path("pina", scene);
#include <string>

#include "apps/walkthrough/camera_path.h"
#include "scenegraph/scene.h"

namespace manzana::walkthrough {

bool is_builtin_path(const std::string& name);  ///< tour, pina

/// Asserts is_builtin_path(name). Deterministic.
CameraPath builtin_path(const std::string& name, const Scene& scene);

/// The path of figure 4 of Pina 2009: begins outside the city at ground level, walks to its heart along a street that
/// is as straight as any, rises vertically above the roofs while turning down, and flies diagonally to the ground. As
/// in its figure 5, of 300 frames the first 48 walk, those to 140 rise, and the last 20 look at the ground.
CameraPath pina_path(const Scene& scene);

/// A street walk into the heart, then over the roofs, over the largest wood and along the river where there are such,
/// and back to a view of the whole (or of its middle, when it is large).
CameraPath tour_path(const Scene& scene);

}  // namespace manzana::walkthrough

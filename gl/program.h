#pragma once
/// Programs from pieces of GLSL that are joined in order, "#version" in the first.
///   Program sky = make_program("sky", {kVersion, shaders::frame_glsl, shaders::sky_vert},
///                              {kVersion, shaders::frame_glsl, shaders::sky_frag});
#include <string_view>
#include <vector>

#include "gl/handle.h"

namespace manzana::gl {

using Pieces = std::vector<std::string_view>;

/// Throws std::runtime_error with `name`, the stage and the driver's log.
Program make_program(std::string_view name, const Pieces& vertex, const Pieces& fragment);
Program make_compute_program(std::string_view name, const Pieces& pieces);

}  // namespace manzana::gl

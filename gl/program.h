#pragma once
/// Programs from pieces of GLSL that are joined in order, "#version" in the first.
///   Program sky = make_program("sky", {kVersion, shaders::frame_glsl, shaders::sky_vert},
///                              {kVersion, shaders::frame_glsl, shaders::sky_frag});
#include <initializer_list>
#include <string_view>

#include "gl/handle.h"

namespace manzana::gl {

using Pieces = std::initializer_list<std::string_view>;

/// Throws std::runtime_error with `name`, the stage and the driver's log.
Program make_program(std::string_view name, Pieces vertex, Pieces fragment);

}  // namespace manzana::gl

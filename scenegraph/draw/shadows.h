#pragma once
/// Soft dark ground under cars and trees: one quad each, over the surfaces.
#include <string_view>

#include "gl/program.h"
#include "scenegraph/draw/instances.h"

namespace manzana::draw {

/// `vertex` makes of vertices 0 to 3 a quad, for each instance.
gl::Program make_shadow(std::string_view name, std::string_view vertex);

/// Multiplies what is drawn already. With an array bound that has what the program reads.
Drawn draw_shadows(const gl::Program& program, std::uint32_t instances);

}  // namespace manzana::draw

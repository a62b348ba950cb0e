#pragma once
/// Sky, and the ground without end below the horizon: two fans at infinite distance, drawn last, so that only what
/// nothing covers is shaded.
#include "gl/program.h"

namespace manzana::draw {

struct Sky {
  explicit Sky(bool photo);  ///< the ground has one (photo_layer.h)
  gl::VertexArray nothing;   ///< core profile wants one bound
  gl::Program above, below;
};
void draw_sky(const Sky& sky);

}  // namespace manzana::draw

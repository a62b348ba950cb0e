#pragma once
/// Sky, and the ground without end below the horizon: one triangle at infinite distance, drawn last, so that only what
/// nothing covers is shaded.
#include "gl/program.h"

namespace manzana::draw {

struct Sky {
  Sky();
  gl::VertexArray nothing;  ///< core profile wants one bound
  gl::Program program;
};
void draw_sky(const Sky& sky);

}  // namespace manzana::draw

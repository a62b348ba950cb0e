#pragma once
/// Sky, and the ground without end below the horizon: two fans at infinite distance, drawn last, so that only what
/// nothing covers is shaded.
#include <optional>

#include "gl/program.h"

namespace manzana::draw {

struct Sky {
  explicit Sky(bool with_photo);  ///< the ground has one (photo_layer.h)
  gl::VertexArray nothing;        ///< core profile wants one bound
  gl::Program above, below;
  std::optional<gl::Program> photo;  ///< of what is below that alone, if there is one
};
void draw_sky(const Sky& sky);
/// Without a sky: the ground's photo where no surface lies; nothing without one.
void draw_bare_photo(const Sky& sky);

}  // namespace manzana::draw

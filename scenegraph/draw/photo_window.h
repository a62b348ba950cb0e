#pragma once
/// Which squares of a level of the ground's photo are held: a window about where one looks, that moves by strips.
///   Squares wanted = window_about(focus, side, {level.columns, level.rows});
///   held = kept(held, wanted);
///   while (held != wanted) { Squares strip = next_strip(held, wanted); ...upload it...; held = joined(held, strip); }
#include <glm/vec2.hpp>

#include "culling/vec.h"

namespace manzana::draw {

/// Columns and rows, half-open. The default is empty.
struct Squares {
  glm::ivec2 low{0}, high{0};
  bool empty() const { return low.x >= high.x || low.y >= high.y; }
  glm::ivec2 size() const { return high - low; }
  bool operator==(const Squares&) const = default;
};

/// At most `side` a side, within the level; by steps of some squares, so that a slow walk moves it seldom.
Squares window_about(const Vec2d& focus, int side, const glm::ivec2& level);
/// What of it stays; without any an empty one in the middle.
Squares kept(const Squares& held, const Squares& wanted);
/// At most 64 wide, beside what is held or in its middle; within `wanted`. Precondition: held != wanted, within it.
Squares next_strip(const Squares& held, const Squares& wanted);
Squares joined(const Squares& held, const Squares& strip);

}  // namespace manzana::draw

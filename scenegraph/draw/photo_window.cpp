#include "scenegraph/draw/photo_window.h"

#include <algorithm>
#include <glm/common.hpp>

namespace manzana::draw {
namespace {

using glm::ivec2;
constexpr int kStrip = 64;

}  // namespace

Squares window_about(const Vec2d& focus, int side, const ivec2& level) {
  const ivec2 size = glm::min(ivec2(side), level);
  const Vec2d low = glm::clamp(focus - 0.5 * side, Vec2d(0), Vec2d(level - size));
  const ivec2 stepped = ivec2(glm::round(low / double{kStrip})) * kStrip;
  const ivec2 first = glm::clamp(stepped, ivec2(0), level - size);
  return {first, first + size};
}

Squares kept(const Squares& held, const Squares& wanted) {
  const Squares both{glm::max(held.low, wanted.low), glm::min(held.high, wanted.high)};
  if (!both.empty()) return both;
  const ivec2 middle = (wanted.low + wanted.high) / 2;
  return {middle, middle};
}

Squares next_strip(const Squares& held, const Squares& wanted) {
  if (held.empty()) return {glm::max(held.low - kStrip / 2, wanted.low), glm::min(held.low + kStrip / 2, wanted.high)};
  Squares strip = held;
  if (held.low.x > wanted.low.x)
    strip.high.x = held.low.x, strip.low.x = std::max(wanted.low.x, held.low.x - kStrip);
  else if (held.high.x < wanted.high.x)
    strip.low.x = held.high.x, strip.high.x = std::min(wanted.high.x, held.high.x + kStrip);
  else if (held.low.y > wanted.low.y)
    strip.high.y = held.low.y, strip.low.y = std::max(wanted.low.y, held.low.y - kStrip);
  else
    strip.low.y = held.high.y, strip.high.y = std::min(wanted.high.y, held.high.y + kStrip);
  return strip;
}

Squares joined(const Squares& held, const Squares& strip) {
  return held.empty() ? strip : Squares{glm::min(held.low, strip.low), glm::max(held.high, strip.high)};
}

}  // namespace manzana::draw

#pragma once
/// The planes of a frustum side by side, four to a register, for a query that asks about many shapes. Answers and
/// rounding are those of culling/overlap.h, for shapes that are finite and not empty.
///   const FrustumLanes lanes(frustum);                  // once a query
///   to_overlap(sides(lanes, sphere))
#include <array>

#include "culling/overlap.h"
#include "culling/simd.h"

namespace manzana::culling {

class FrustumLanes {
 public:
  explicit FrustumLanes(const Frustum& frustum) {
    std::array<std::array<float, 8>, 5> columns{};
    columns[3].fill(std::numeric_limits<float>::max());  // a lane without a plane is farther away than any radius
    for (std::size_t k = 0; k < frustum.planes.size() && k < static_cast<std::size_t>(frustum.count); ++k) {
      const Plane& p = frustum.planes[k];
      columns[0][k] = p.normal.x;
      columns[1][k] = p.normal.y;
      columns[2][k] = p.normal.z;
      columns[3][k] = p.offset;
      columns[4][k] = frustum.slack[k];
    }
    const auto half = [&](std::size_t from) {
      return Half{load(&columns[0][from]), load(&columns[1][from]), load(&columns[2][from]), load(&columns[3][from]),
                  load(&columns[4][from])};
    };
    low_ = half(0);
    high_ = half(4);
  }

  friend Sides sides(const FrustumLanes& frustum, const Sphere& sphere) {
    const Float4 r = splat(sphere.radius + kMargin * sphere.radius);
    const Float4 x = splat(sphere.center.x), y = splat(sphere.center.y), z = splat(sphere.center.z);
    const auto test = [&](const Half& h) {
      const Terms at{h.x * x, h.y * y, h.z * z};
      const Float4 s = h.distance(at), reach = r + h.margin(at);
      return Sides{less(s, -reach), less(reach, s)};
    };
    return join(test(frustum.low_), test(frustum.high_));
  }

  friend Sides sides(const FrustumLanes& frustum, const Box& box) {
    const auto test = [&](const Half& h) {
      const Terms a{h.x * splat(box.min.x), h.y * splat(box.min.y), h.z * splat(box.min.z)};
      const Terms b{h.x * splat(box.max.x), h.y * splat(box.max.y), h.z * splat(box.max.z)};
      const Terms best{maximum(a.x, b.x), maximum(a.y, b.y), maximum(a.z, b.z)};
      const Terms worst{minimum(a.x, b.x), minimum(a.y, b.y), minimum(a.z, b.z)};
      return Sides{less(h.distance(best), -h.margin(best)), less(h.margin(worst), h.distance(worst))};
    };
    return join(test(frustum.low_), test(frustum.high_));
  }

  /// A leaf of the BqR-Tree; its box is asked about only where its sphere leaves a doubt.
  friend Sides sides(const FrustumLanes& frustum, const Sphere& sphere, const Box& box) {
    const Sides ball = sides(frustum, sphere);
    return to_overlap(ball) == Overlap::crosses ? both(ball, sides(frustum, box)) : ball;
  }

 private:
  struct Terms {
    Float4 x, y, z;
  };
  struct Half {
    Float4 x, y, z, offset, slack;
    Float4 distance(const Terms& t) const { return t.x + t.y + t.z + offset; }
    Float4 margin(const Terms& t) const {
      return splat(kMargin) * (abs(t.x) + abs(t.y) + abs(t.z) + abs(offset)) + slack;
    }
  };
  static Sides join(const Sides& low, const Sides& high) {
    return {low.outside | high.outside << 4, low.inside | high.inside << 4};
  }
  Half low_, high_;
};

}  // namespace manzana::culling

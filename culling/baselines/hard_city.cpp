#include <algorithm>
#include <cfloat>
#include <cmath>
#include <optional>

#include "culling/baselines/hard_cases.h"
#include "culling/baselines/touching.h"

namespace manzana::baselines {
namespace {

using culling::BlockVolume;
using culling::BoxD;
using culling::ExactView;
using culling::SphereD;

/// Metres: about how far from the eye touches are looked for; the near face is within it, for one in three the far face
/// too.
double random_reach(const ExactView& body, Random& random) {
  double least = 1;
  for (std::size_t i = 0; i < 4; ++i) least = std::max(least, glm::length(body.corners[i]));
  const bool to_the_end = !body.infinite() && random.chance(0.3);
  return std::max(least, to_the_end ? std::abs(body.planes[culling::kFar].offset) : random.scale(1, 1e6));
}

/// A city lies round the eye, or at a spot on a face far from it: there floats are small, and only double has rounded.
class Maker {
 public:
  Maker(const ExactView& body, Random& random)
      : body_(body),
        random_(random),
        reach_(random_reach(body, random)),
        width_(reach_),
        smallest_(random.chance(0.5) ? 1e-9 : 1e-2),
        largest_(random.chance(0.2) ? 1e7 : reach_) {
    if (random.chance(0.7)) return;
    spot_ = touch(body, random, 1, reach_);
    largest_ = width_ = random.scale(1e-6, 1e3);
  }

  BoxD anywhere() {
    const double size = random_.scale(smallest_, largest_);
    const Vec3d half = flattened(size * Vec3d{random_.in(0.1, 1), random_.in(0.1, 1), random_.in(0.1, 1)});
    const Vec3d middle = body_.eye + place(size);
    return {middle - half, middle + half};
  }

  BoxD tangent() {
    const Vec3d size = flattened({random_size(), random_size(), random_size()});
    if (spot_ || random_.chance(0.6)) return box_on(body_, any_touch(), size, depth());
    for (;;) {
      const BoxD box = box_along_axis(body_, random_, size, depth(), reach_);
      if (near_enough(center(box) - body_.eye)) return box;
    }
  }

  /// A block whose sphere touches, with a point in it where it is deepest.
  BlockVolume tangent_ball(BoxD& content) {
    const Touch at = any_touch();
    const double radius = random_size(), deep = depth();
    const Vec3d middle = body_.eye + (at.point + (radius - deep) * at.away);
    const Vec3d deepest = body_.eye + (at.point - deep * random_.in(0.1, 0.9) * at.away);
    content = {deepest, deepest};
    const double reach = glm::distance(middle, deepest) * (1 + 4 * DBL_EPSILON);
    return {Vec2d(middle), merge(BoxD{middle - radius, middle + radius}, deepest), {middle, std::max(radius, reach)}};
  }

 private:
  bool near_enough(const Vec3d& p, double size = 0) const { return glm::length(p) < 3 * (reach_ + size); }
  double depth() { return random_.scale(1e-9, 1e-1) * (random_.chance(0.8) ? 1 : -1); }
  double random_size() { return random_.scale(smallest_, width_); }
  /// One in ten is flat, a line or a point.
  Vec3d flattened(Vec3d size) {
    if (random_.chance(0.9)) return size;
    for (int i = 0; i < 3; ++i) size[i] *= random_.chance(0.5) ? 0 : 1;
    return size;
  }
  /// Relative to the eye, of an object of that size.
  Vec3d place(double size) {
    if (spot_) return spot_->point + random_.direction() * random_.in(0, width_);
    return random_.chance(0.5) ? near_body(size) : random_.direction() * random_.in(0, reach_);
  }
  Vec3d near_body(double size) {
    for (;;) {
      const double metres = random_distance(random_, reach_);
      const Vec3d p = point_inside(body_, random_, metres) + random_.direction() * (size * random_.in(0, 2));
      if (near_enough(p, size)) return p;
    }
  }
  Touch any_touch() {
    if (spot_) return slid(*spot_);
    for (;;) {
      const Touch at = touch(body_, random_, 1 + static_cast<int>(random_.below(3)), reach_);
      if (near_enough(at.point)) return at;
    }
  }

  /// Along the face. (Beyond its edge there is nothing to be lost.)
  Touch slid(const Touch& at) {
    const Vec3d step = random_.direction() * random_.in(0, width_);
    return {at.point + (step - glm::dot(step, at.away) * at.away), at.away};
  }

  const ExactView& body_;
  Random& random_;
  double reach_, width_, smallest_, largest_;  // metres
  std::optional<Touch> spot_;
};

void add_object(HardCity& hard, const BoxD& box, bool tangent) {
  hard.city.boxes.push_back(box);
  hard.tangent.push_back(tangent);
}

void close_block(City& city, const BlockVolume& block) {
  city.blocks.push_back(block);
  city.first.push_back(city.objects());
  city.bounds = merge(city.bounds, block.box);
}

BlockVolume enclosing_block(const City& city) {
  BoxD box;
  for (std::uint32_t i = city.first.back(); i < city.objects(); ++i) box = merge(box, city.boxes[i]);
  return {Vec2d(center(box)), box, enclosing_sphere(box)};
}

}  // namespace

HardCity hard_city(const ExactView& truth, Random& random, const HardCityOptions& options) {
  Maker maker(truth, random);
  HardCity hard;
  City& city = hard.city;
  while (city.objects() < options.objects) {
    if (random.chance(options.tangent_share * 0.5)) {
      BoxD content;
      const BlockVolume ball = maker.tangent_ball(content);
      add_object(hard, content, true);
      close_block(city, ball);
      continue;
    }
    const std::uint64_t bag = random.chance(0.7) ? 1 : 2 + random.below(40);
    for (std::uint64_t i = 0; i < bag; ++i) {
      const bool tangent = random.chance(options.tangent_share);
      add_object(hard, tangent ? maker.tangent() : maker.anywhere(), tangent);
    }
    close_block(city, enclosing_block(city));
  }
  city.kinds.assign(city.boxes.size(), ObjectKind::building);
  city.triangles.assign(city.boxes.size(), 1);
  return hard;
}

}  // namespace manzana::baselines

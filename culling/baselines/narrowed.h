#pragma once
/// A city's boxes in float, relative to one origin in the middle of it.
#include "culling/baselines/city.h"

namespace manzana::baselines {

struct Narrowed {
  Vec3d origin{0, 0, 0};            ///< in L, whole metres
  std::vector<culling::Box> boxes;  ///< a row an object, rounded outward
};

inline Vec3d origin_of(const City& city) {
  return city.bounds.empty() ? Vec3d(0) : glm::round(culling::center(city.bounds));
}

inline Narrowed narrowed(const City& city) {
  Narrowed all{origin_of(city), {}};
  all.boxes.reserve(city.objects());
  for (const culling::BoxD& box : city.boxes) all.boxes.push_back(narrow(box, all.origin));
  return all;
}

}  // namespace manzana::baselines

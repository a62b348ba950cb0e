#pragma once
/// A generated city with its tree, ready to be asked; and every kind of vectors that can answer.
#include <hwy/highway.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "culling/baselines/cases.h"
#include "culling/baselines/random.h"
#include "culling/cull.h"

namespace manzana::culling::test {

using baselines::City;
using baselines::Random;

struct Scene {
  City city;
  std::vector<ClassMask> classes;  ///< a row an object of the city, or none
  BqrTree tree;
  std::vector<BoxD> boxes;  ///< of the objects, in the tree's order
};

inline Scene make_scene(City city, std::vector<ClassMask> classes = {}) {
  Scene s{std::move(city), std::move(classes), {}, {}};
  s.tree = build_bqr_tree(s.city.blocks, {s.city.first, s.city.boxes, s.classes});
  for (const std::uint32_t row : s.tree.object_order) s.boxes.push_back(s.city.boxes[row]);
  return s;
}

inline Scene city_10k(const Vec3d& place = Vec3d(0)) {
  return make_scene(moved(baselines::make_city(10'000, 1), place));
}

inline Planes planes_of(const Scene& s, const View& view) { return make_planes(s.tree, make_frustum(view)); }

/// A flag a block or an object; no two runs may meet, none may be empty.
template <class Run>
std::vector<bool> flags(std::span<const Run> runs, std::size_t n) {
  std::vector<bool> seen(n);
  for (const Run& run : runs) {
    REQUIRE(run.first < run.last);
    REQUIRE(run.last <= n);
    for (std::uint32_t i = run.first; i < run.last; ++i) {
      REQUIRE_FALSE(seen[i]);
      seen[i] = true;
    }
  }
  return seen;
}
inline std::vector<bool> seen_objects(const Scene& s, const Answer& answer) {
  return flags(answer.objects(), s.boxes.size());
}

inline std::uint64_t count(const std::vector<bool>& seen) {
  return static_cast<std::uint64_t>(std::count(seen.begin(), seen.end(), true));
}
inline std::uint64_t differing(const std::vector<bool>& a, const std::vector<bool>& b) {
  std::uint64_t n = 0;
  for (std::size_t i = 0; i < a.size(); ++i) n += a[i] != b[i] ? 1U : 0U;
  return n;
}

/// f(name) once with each kind of vectors that the processor at hand has, the widest first, plain numbers last.
template <class F>
void on_each_target(F f) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    INFO(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    f(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(0);
  }
}

}  // namespace manzana::culling::test

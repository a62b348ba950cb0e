// The box round a view, for peers that can be asked about boxes only.
#include "culling/baselines/view_box.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "culling/baselines/exact.h"
#include "tests/support/random.h"

namespace manzana::baselines {
namespace {

using culling::BoxD;
using culling::View;

bool meet(const BoxD& a, const BoxD& b) {
  return !a.empty() && !b.empty() && glm::all(glm::lessThanEqual(a.min, b.max)) &&
         glm::all(glm::lessThanEqual(b.min, a.max));
}

View any_view(const BoxD& bounds, support::Random& random) {
  const Vec3d at{random.within(-0.5, 1.5), random.within(-0.5, 1.5), random.within(-0.5, 1.5)};
  const Vec3d forward{random.within(-1, 1), random.within(-1, 1), random.within(-1, 1)};
  const double far_m = random.below(2) == 0 ? random.within(1, 5000) : std::numeric_limits<double>::infinity();
  const double fovy = random.below(4) == 0 ? 179 * std::numbers::pi / 180 : random.within(1e-5, 2.5);
  View view = culling::look(bounds.min + at * (bounds.max - bounds.min), forward, {0, 0, 1}, fovy, 1.6, 0.1, far_m);
  if (random.below(2) == 0) view.right = -view.right;
  if (random.below(2) == 0) view.tan_left *= random.within(-0.9, 2);
  return view;
}

TEST_CASE("the box of a view meets every box that the view meets") {
  support::Random random(71);
  int seen = 0, spared = 0;
  for (const Vec3d& place : {Vec3d(0), Vec3d(676000, 4613000, 200), Vec3d(4777000, -73500, 4229000)}) {
    const BoxD bounds{place - 2000.0, place + Vec3d(2000, 2000, 300)};
    for (int i = 0; i < 400; ++i) {
      const View view = any_view(bounds, random);
      const BoxD box = view_box(make_frustum(view), bounds);
      const culling::ExactView exact = culling::make_exact(view);
      for (int k = 0; k < 50; ++k) {
        const Vec3d low = bounds.min + Vec3d{random.unit(), random.unit(), random.unit()} * (bounds.max - bounds.min);
        const BoxD object{low, glm::min(low + random.within(0, 40), bounds.max)};
        if (!exactly_overlaps(exact, object)) {
          spared += meet(box, object) ? 0 : 1;
          continue;
        }
        ++seen;
        REQUIRE(meet(box, object));
      }
    }
  }
  CHECK(seen > 3000);
  CHECK(spared > 3000);
}

TEST_CASE("a view without finite sides is as large as the city") {
  const BoxD bounds{{-5, -6, -7}, {8, 9, 10}};
  View view;
  view.tan_right = std::numeric_limits<double>::infinity();
  const BoxD box = view_box(make_frustum(view), bounds);
  CHECK(box.min == bounds.min);
  CHECK(box.max == bounds.max);
}

}  // namespace
}  // namespace manzana::baselines

// Sphere against box, by exact arithmetic [numerics 2.4].
#include <CGAL/Exact_rational.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "culling/baselines/random.h"
#include "culling/overlap.h"

namespace manzana::culling::test {
namespace {

using baselines::Random;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

using Exact = CGAL::Exact_rational;
bool exact_overlaps(const Sphere& s, const Box& b) {
  const auto exact = [](float x) { return Exact(static_cast<double>(x)); };
  const Exact r = exact(s.radius);
  Exact square = 0;
  for (int k = 0; k < 3; ++k) {
    const Exact low = exact(b.min[k]) - exact(s.center[k]), high = exact(s.center[k]) - exact(b.max[k]);
    const Exact gap = low > 0 ? low : high > 0 ? high : Exact(0);
    square += gap * gap;
  }
  return square <= r * r;
}

TEST_CASE("sphere and box: touching counts, near misses do not") {
  const Box box{Vec3(3, 4, -1), Vec3(9, 9, 1)};
  CHECK(overlaps(Sphere{Vec3(0), 5}, box));
  CHECK_FALSE(overlaps(Sphere{Vec3(0), std::nextafter(5.0F, 0.0F)}, box));
  CHECK_FALSE(overlaps(Sphere{Vec3(0), 5}, Box{Vec3(3, std::nextafter(4.0F, 5.0F), -1), Vec3(9)}));
  CHECK(overlaps(Sphere{Vec3(5, 5, 0), 0}, box));
  CHECK(overlaps(Sphere{Vec3(3, 5, 0), 0}, box));  // a point on a face
  CHECK(overlaps(Sphere{Vec3(3e38F, 0, 0), 3e38F}, Box{Vec3(-1), Vec3(0)}));
  CHECK_FALSE(overlaps(Sphere{}, box));
  CHECK_FALSE(overlaps(Sphere{Vec3(5, 5, 0), 1}, Box{}));
  CHECK(overlaps(Sphere{Vec3(kNan), 1}, box));
  CHECK(overlaps(Sphere{Vec3(100), 1}, Box{Vec3(kNan), Vec3(0)}));
}

TEST_CASE("sphere and box agree with exact arithmetic") {
  Random random(34);
  int touching = 0, differ = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto whole = [&] { return static_cast<float>(static_cast<double>(random.below(25)) - 12); };
    const Vec3 a{whole(), whole(), whole()}, b{whole(), whole(), whole()};
    const Box box{glm::min(a, b), glm::max(a, b)};
    const Sphere ball{{whole(), whole(), whole()}, static_cast<float>(random.below(12))};
    const bool exact = exact_overlaps(ball, box);
    touching += exact && !exact_overlaps(Sphere{ball.center, ball.radius * 0.999F}, box) ? 1 : 0;
    differ += exact != overlaps(ball, box) ? 1 : 0;
  }
  CHECK(differ == 0);
  CHECK(touching > 100);
}

}  // namespace
}  // namespace manzana::culling::test

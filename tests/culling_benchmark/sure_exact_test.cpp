#include "culling/baselines/sure_exact.h"

#include <bit>
#include <cmath>

#include "culling/baselines/cases.h"
#include "tests/support/random.h"

using namespace manzana;
using namespace manzana::culling;

namespace {

View random_view(support::Random& random, double away) {
  const auto direction = [&] { return Vec3d(random.within(-1, 1), random.within(-1, 1), random.within(-1, 1)); };
  const Vec3d eye = direction() * away;
  const double far_m = random.below(2) == 0 ? std::numeric_limits<double>::infinity() : random.within(10, 1000);
  View view = look(eye, direction(), direction(), random.within(0.02, 3.1), random.within(0.3, 3), 0.1, far_m);
  if (random.below(3) == 0) view.tan_left *= random.within(0.1, 3);  // off the axis
  return view;
}

/// A corner of the frustum, a point on an edge, on a side or inside; in L, as nearly as doubles have it.
Vec3d point_of(const View& view, support::Random& random) {
  const auto end_or_between = [&](double low, double high) {
    const int which = random.below(3);
    return which == 0 ? low : which == 1 ? high : random.within(low, high);
  };
  const double depth = end_or_between(view.near_m, std::isfinite(view.far_m) ? view.far_m : 500);
  const double x = end_or_between(view.tan_left, view.tan_right), y = end_or_between(view.tan_bottom, view.tan_top);
  return view.eye + depth * (view.forward + x * view.right + y * view.up);
}

/// A box one of whose corners, edges or sides passes through the point.
BoxD box_at(const Vec3d& point, support::Random& random) {
  BoxD box{point, point};
  for (int axis = 0; axis < 3; ++axis) {
    const double size = random.below(4) == 0 ? 0 : std::exp(random.within(-6, 5));
    const int which = random.below(3);
    box.min[axis] -= which == 0 ? 0 : which == 1 ? size : size / 2;
    box.max[axis] += which == 1 ? 0 : which == 0 ? size : size / 2;
  }
  return box;
}

/// Half of them touch the frustum to the last place, where double alone cannot tell.
std::vector<BoxD> boxes_round(const View& view, support::Random& random, int n) {
  std::vector<BoxD> boxes;
  for (int i = 0; i < n; ++i) {
    const Vec3d away = random.below(2) == 0 ? Vec3d(0) : Vec3d(random.within(-300, 300), random.within(-300, 300), 0);
    boxes.push_back(box_at(point_of(view, random) + away, random));
  }
  boxes.push_back({});
  return boxes;
}

}  // namespace

TEST_CASE("sure exact: the same answers as long double, for boxes that touch and boxes that do not, near and far") {
  support::Random random(11);
  std::size_t seen = 0, all = 0;
  for (const double away : {0.0, 1e3, 7e5, 6.4e6})
    for (int round = 0; round < 400; ++round) {
      const View view = random_view(random, away);
      const auto boxes = boxes_round(view, random, 300);
      const auto expected = exactly_visible(view, boxes);
      const auto bits = SureExact(view).visible(boxes);
      std::size_t wrong = 0;
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        wrong += (bits[i / 64] >> i % 64 & 1) != (expected[i] ? 1U : 0U) ? 1 : 0;
        seen += expected[i] ? 1 : 0;
      }
      CAPTURE(away, round);
      CHECK(wrong == 0);
      all += boxes.size();
    }
  CHECK(seen > all / 4);  // a test whose boxes are all alike proves nothing
  CHECK(seen < all * 3 / 4);
}

TEST_CASE("sure exact: the same answers in a city, all along the flight") {
  const auto& which = *baselines::find_case("C3");
  const baselines::City city = make_city(which, 1);
  for (int frame = 0; frame < 20; ++frame) {
    const View view = flight(city, frame % 2 == 0 ? which.far_m : 300.0, frame / 19.0);
    const auto expected = exactly_visible(view, city.boxes);
    const auto bits = SureExact(view).visible(city.boxes);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < city.boxes.size(); ++i)
      wrong += (bits[i / 64] >> i % 64 & 1) != (expected[i] ? 1U : 0U) ? 1 : 0;
    CAPTURE(frame);
    CHECK(wrong == 0);
  }
}

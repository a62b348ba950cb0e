// The exact answer, against linear programming over the rationals: is there a point in the box that satisfies all
// planes?
#include "culling/baselines/exact.h"

#include <CGAL/Gmpq.h>
#include <CGAL/QP_functions.h>
#include <CGAL/QP_models.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "culling/baselines/hard_cases.h"

namespace manzana::culling::test {
namespace {

using baselines::Random;
using CGAL::Gmpq;
using Program = CGAL::Quadratic_program<Gmpq>;
using Rational3 = std::array<Gmpq, 3>;

Rational3 rational(const Vec3d& v) { return {Gmpq(v.x), Gmpq(v.y), Gmpq(v.z)}; }

/// Row `row` of the program: dot(a - tangent * b, p - eye) >= offset.
void add_plane(Program& program, int row, const Vec3d& a, double tangent, const Vec3d& b, const View& view,
               double offset) {
  const Rational3 eye = rational(view.eye), u = rational(a), v = rational(b);
  Gmpq right = Gmpq(offset);
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Gmpq normal = u[k] - Gmpq(tangent) * v[k];
    program.set_a(i, row, normal);
    right += normal * eye[k];
  }
  program.set_b(row, right);
}

bool some_point_satisfies_all(const View& v, const BoxD& box) {
  Program program(CGAL::LARGER, false, Gmpq(0), false, Gmpq(0));
  add_plane(program, 0, v.right, v.tan_left, v.forward, v, 0);
  add_plane(program, 1, -v.right, -v.tan_right, v.forward, v, 0);
  add_plane(program, 2, v.up, v.tan_bottom, v.forward, v, 0);
  add_plane(program, 3, -v.up, -v.tan_top, v.forward, v, 0);
  add_plane(program, 4, v.forward, 0, v.forward, v, v.near_m);
  if (std::isfinite(v.far_m)) add_plane(program, 5, -v.forward, 0, v.forward, v, -v.far_m);
  for (int i = 0; i < 3; ++i) {
    program.set_l(i, true, Gmpq(box.min[i]));
    program.set_u(i, true, Gmpq(box.max[i]));
  }
  return !CGAL::solve_linear_program(program, Gmpq()).is_infeasible();
}

TEST_CASE("the exact answer is that of rational arithmetic, for anything and for what just touches") {
  Random random(101);
  int seen = 0, asked = 0;
  for (int camera = 0; camera < 200; ++camera) {
    const View view = baselines::hard_view(random, baselines::kPlaces[random.below(baselines::kPlaces.size())]);
    const ExactView exact = make_exact(view);
    const auto hard = baselines::hard_city(exact, random, {.objects = 30, .tangent_share = 0.5});
    for (const BoxD& box : hard.city.boxes) {
      INFO("seed 101, camera " << camera << ", object " << asked);
      const bool truly = some_point_satisfies_all(view, box);
      REQUIRE(exactly_overlaps(exact, box) == truly);
      CHECK((reach_into(exact, box) > 0) <= truly);
      seen += truly ? 1 : 0;
      ++asked;
    }
  }
  CHECK(seen > asked / 4);
  CHECK(seen < asked);
}

TEST_CASE("how far a box reaches in") {
  const ExactView exact = make_exact(look({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1, 1, 1, 100));
  CHECK(reach_into(exact, {{-1, 97, -1}, {1, 120, 1}}) == Approx(3));
  CHECK(reach_into(exact, {{-1, 0, -1}, {1, 1.25, 1}}) == Approx(0.25));
  CHECK(reach_into(exact, {{-1, 101, -1}, {1, 120, 1}}) == 0);
}

}  // namespace
}  // namespace manzana::culling::test

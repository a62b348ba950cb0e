// Volumes: nothing that is inside falls out by rounding [numerics 3].
#include "culling/volumes.h"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>
#include <vector>

#include "culling/baselines/random.h"

namespace manzana::culling::test {
namespace {

using baselines::Random;

using Big = boost::multiprecision::cpp_bin_float_100;
constexpr double kInf = std::numeric_limits<double>::infinity();

Big exact_distance(const Vec3d& a, const Vec3d& b) {
  const Big x = Big(a.x) - b.x, y = Big(a.y) - b.y, z = Big(a.z) - b.z;
  return sqrt(x * x + y * y + z * z);
}
bool contains(const SphereD& outer, const SphereD& inner) {
  return exact_distance(outer.center, inner.center) + inner.radius <= outer.radius;
}

void check_enclosing(const std::vector<SphereD>& members) {
  const SphereD ball = enclosing_sphere(members);
  for (const SphereD& member : members) CHECK((member.empty() || contains(ball, member)));
}

TEST_CASE("empty volumes are passed over") {
  CHECK(SphereD{}.empty());
  CHECK(BoxD{}.empty());
  CHECK(enclosing_sphere(std::vector<SphereD>{}).empty());
  CHECK(enclosing_sphere(std::vector<SphereD>{SphereD{}, SphereD{{0, 0, 0}, -1}}).empty());
  CHECK(enclosing_sphere(BoxD{}).empty());
  CHECK(narrow(SphereD{}, Vec3d(1)).empty());
  CHECK(narrow(BoxD{}, Vec3d(1)).empty());
  const BoxD box{{1, 2, 3}, {4, 5, 6}};
  CHECK(merge(box, BoxD{}).min == box.min);
  CHECK(merge(BoxD{}, box).max == box.max);
  CHECK(merge(BoxD{}, BoxD{}).empty());
  const SphereD one = enclosing_sphere(std::vector<SphereD>{{{0, 0, 0}, -1}, {{10, 0, 0}, 2}});
  CHECK(one.center == Vec3d(10, 0, 0));  // the usual formula would give 6.5 [numerics R5]
  CHECK(one.radius == Approx(2));
}

TEST_CASE("merge") {
  const BoxD box = merge(merge(BoxD{}, Vec3d(1, 5, 2)), Vec3d(3, 0, 2));
  CHECK(box.min == Vec3d(1, 0, 2));
  CHECK(box.max == Vec3d(3, 5, 2));
  CHECK(center(BoxD{Vec3d(-1e308), Vec3d(1e308)}) == Vec3d(0));
  CHECK(center(BoxD{Vec3d(1.5e308), Vec3d(1.7e308)}) == Vec3d(1.6e308));
}

TEST_CASE("enclosing sphere: the hard cases") {
  check_enclosing({{{1, 2, 3}, 4}, {{1, 2, 3}, 4}});                      // concentric, equal
  check_enclosing({{{1, 2, 3}, 0}, {{1, 2, 3}, 0}});                      // one point twice
  check_enclosing({{{0, 0, 0}, 0}, {{1e-12, 0, 0}, 0}});                  // close
  check_enclosing({{{0, 0, 0}, 0}, {{1e-170, 2e-170, 0}, 0}});            // squares vanish
  check_enclosing({{{0, 0, 0}, 5e-324}, {{1e-323, 2e-323, 5e-324}, 0}});  // subnormal
  check_enclosing({{{0, 0, 0}, 1e7}, {{1e7 - 1e-3, 0, 0}, 1e-3}});        // tangent from inside
  check_enclosing({{{0, 0, 0}, 1e9}, {{1e9, 0, 0}, 1e-3}});               // a little pokes out
  check_enclosing({{{0, 0, 0}, 1}, {{0, 0, 0.1}, 50}});                   // child contains all
  check_enclosing({{{-1e19, 0, 0}, 1}, {{1e19, 1e19, 0}, 1}});
  check_enclosing({{{-1e200, 0, 0}, 1}, {{1e200, 1e200, 1e200}, 1e180}});
  check_enclosing({{{676000.1, 4613000.3, 200}, 31.7}});
  std::vector<SphereD> row;
  for (int i = 0; i < 1000; ++i) row.push_back({{i * 0.1, i * 0.2, i * 0.3}, 0.01 * i});
  check_enclosing(row);
}

TEST_CASE("enclosing sphere contains its members, whatever their order") {
  Random random(21);
  for (int i = 0; i < 2000; ++i) {
    const double place = random.scale(1, 5e6), size = random.scale(1e-3, 1e4);
    const Vec3d at = random.direction() * place;
    std::vector<SphereD> members;
    for (std::uint64_t n = 1 + random.below(20); n > 0; --n)
      members.push_back({at + random.direction() * random.in(0, size), random.in(0, size)});
    check_enclosing(members);
    const SphereD ball = enclosing_sphere(members);
    std::reverse(members.begin(), members.end());
    const SphereD other = enclosing_sphere(members);
    CHECK(ball.center == other.center);
    CHECK(ball.radius == other.radius);
  }
}

TEST_CASE("sphere of a box holds its corners and is no larger than it must be") {
  Random random(22);
  for (int i = 0; i < 5000; ++i) {
    const Vec3d low = random.direction() * random.scale(1e-3, 5e6);
    const BoxD box{low, low + glm::abs(random.direction()) * random.scale(1e-6, 1e5)};
    const SphereD ball = enclosing_sphere(box);
    for (int k = 0; k < 8; ++k) {
      const Vec3d corner{k & 1 ? box.max.x : box.min.x, k & 2 ? box.max.y : box.min.y, k & 4 ? box.max.z : box.min.z};
      REQUIRE(exact_distance(ball.center, corner) <= ball.radius);
    }
    REQUIRE(ball.radius <= glm::length(box.max - box.min) / 2 * (1 + 1e-14) + 1e-15 * glm::length(low));
  }
}

/// Enlarged by at most so much: a few units of float of the place.
TEST_CASE("narrow rounds outward, and only just") {
  Random random(23);
  for (int i = 0; i < 20000; ++i) {
    const Vec3d origin = i % 3 == 0 ? Vec3d(0) : glm::round(random.direction() * random.scale(1, 5e6));
    const Vec3d c = origin + random.direction() * random.scale(1e-30, 1e6);
    const SphereD ball{c, i % 7 == 0 ? 0 : random.scale(1e-30, 1e5)};
    const Sphere small = narrow(ball, origin);
    const Vec3d moved{static_cast<double>(small.center.x), static_cast<double>(small.center.y),
                      static_cast<double>(small.center.z)};
    const Big x = Big(c.x) - origin.x - moved.x, y = Big(c.y) - origin.y - moved.y, z = Big(c.z) - origin.z - moved.z;
    REQUIRE(sqrt(x * x + y * y + z * z) + ball.radius <= small.radius);
    const double slack = 3e-7 * (glm::length(c - origin) + ball.radius) + 1e-37;
    REQUIRE(static_cast<double>(small.radius) <= ball.radius + slack);

    const BoxD box{c, c + glm::abs(random.direction()) * ball.radius};
    const Box close = narrow(box, origin);
    for (int k = 0; k < 3; ++k) {
      REQUIRE(Big(close.min[k]) <= Big(box.min[k]) - origin[k]);
      REQUIRE(Big(close.max[k]) >= Big(box.max[k]) - origin[k]);
      REQUIRE(static_cast<double>(close.max[k]) - (box.max[k] - origin[k]) <= slack);
      REQUIRE((box.min[k] - origin[k]) - static_cast<double>(close.min[k]) <= slack);
    }
  }
}

TEST_CASE("narrow keeps what a float can hold, and is infinite beyond") {
  const Box box = narrow(BoxD{{-1, 0, 5}, {1, 2, 7.5}}, Vec3d(0, 0, 5));
  CHECK(box.min == Vec3(-1, 0, 0));
  CHECK(box.max == Vec3(1, 2, 2.5));
  const Box wide = narrow(BoxD{Vec3d(-1e308), Vec3d(1e308)}, Vec3d(0));
  CHECK(wide.min == Vec3(-std::numeric_limits<float>::infinity()));
  CHECK(wide.max == Vec3(std::numeric_limits<float>::infinity()));
  CHECK(narrow(SphereD{Vec3d(0), kInf}, Vec3d(0)).radius == std::numeric_limits<float>::infinity());
}

}  // namespace
}  // namespace manzana::culling::test

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/import/meshes/mesh_checks.h"

using namespace checks;

TEST_CASE("pack_normal keeps directions within a thousandth, and axes exactly") {
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)})
    CHECK(unpack_normal(pack_normal(axis)) == axis);
  CHECK(pack_normal({1, 0, 0}) == 511U);
  CHECK(pack_normal({0, -1, 0}) == (513U << 10));
  Random random{11};
  for (int i = 0; i < 10000; ++i) {
    const Vec3 n = glm::normalize(Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)));
    const Vec3 error = glm::abs(unpack_normal(pack_normal(n)) - n);
    CHECK(std::max({error.x, error.y, error.z}) <= 0.5F / 511 + 1e-6F);
  }
}

// Points or lines: told by the leaf's shape.
#include "foliage/leaf_form.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "foliage/leaf_cloud.h"
#include "foliage/random.h"

namespace manzana::foliage {
namespace {

PlantQuad quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  PlantQuad out{};
  out.corners[0].position = a, out.corners[1].position = b, out.corners[2].position = c, out.corners[3].position = d;
  out.shades.fill(255);
  return out;
}

PlantQuad rectangle(float wide, float high) { return quad({0, 0, 0}, {wide, 0, 0}, {wide, 0, high}, {0, 0, high}); }

/// A blade that bends over, of eight quads.
std::vector<PlantQuad> bent_blade() {
  std::vector<PlantQuad> quads;
  const auto at = [](int i, float x) {
    const float t = static_cast<float>(i) / 8;
    return Vec3(x * (1 - t), 0.25F * t * t, t * (1 - 0.3F * t));
  };
  for (int i = 0; i < 8; ++i) quads.push_back(quad(at(i, -.01F), at(i, .01F), at(i + 1, .01F), at(i + 1, -.01F)));
  return quads;
}

/// Fingers from one point, in a half circle.
std::vector<PlantQuad> hand(int fingers) {
  std::vector<PlantQuad> quads;
  for (int i = 0; i < fingers; ++i) {
    const float angle = 3.14F * static_cast<float>(i) / static_cast<float>(fingers - 1);
    const Vec3 out(std::cos(angle), 0, std::sin(angle)), across(-out.z * .02F, 0, out.x * .02F);
    quads.push_back(quad(-across, across, out + across, out - across));
  }
  return quads;
}

}  // namespace

TEST_CASE("blades and needles are thin and cards and hands are not") {
  const auto thin = [](const std::vector<PlantQuad>& quads, double alpha = 1) {
    return leaf_form(quads, alpha).thin();
  };
  CHECK(thin({rectangle(.01F, .2F)}));
  CHECK(thin(bent_blade()));
  CHECK_FALSE(thin({rectangle(.1F, .2F)}));
  CHECK_FALSE(thin({rectangle(.1F, .2F)}, 0.2));  // a card of needles: many lines are no line
  CHECK_FALSE(thin(hand(5)));
  CHECK(thin({rectangle(.05F, .2F)}, 0.3));
  const LeafForm form = leaf_form(std::vector{rectangle(.01F, .2F)}, 1);
  CHECK(form.length == Approx(0.2).margin(1e-4));
  CHECK(form.width == Approx(0.01).margin(1e-4));
  CHECK(std::abs(form.axis.z) == Approx(1));
}

TEST_CASE("a leaf of no size is not thin and does not fail") {
  const LeafForm form = leaf_form(std::vector{quad(Vec3(1), Vec3(1), Vec3(1), Vec3(1))}, 1);
  CHECK(form.length > 0);
  CHECK(std::isfinite(form.width));
}

TEST_CASE("a line is as wide as its leaf without its air") {
  const LineSegment line = leaf_line(rectangle(.02F, .5F), {0, 0, 1}, 0.5);
  CHECK(glm::distance(line.a, line.b) == Approx(0.5));
  CHECK(std::abs(line.b.z - line.a.z) == Approx(0.5));
  CHECK(static_cast<double>(2 * line.radius_a) == Approx(0.5 * 0.02));
  CHECK(line.radius_a == line.radius_b);
}

}  // namespace manzana::foliage

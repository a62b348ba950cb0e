#include "foliage/branch_shape.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "ortho_mask.h"
#include "tiny_plants.h"

namespace manzana::foliage {
namespace {

/// A tube round a helix, which tapers.
Plant curly_plant(int points, int sides, float turns) {
  Plant plant;
  std::vector<StemPoint> stem;
  for (int i = 0; i < points; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(points - 1), angle = turns * 6.2831853F * t;
    const Vec3 place(0.4F * std::cos(angle), 0.4F * std::sin(angle), 2 * t);
    const Vec3 heading =
        glm::normalize(Vec3(-0.4F * turns * 6.28F * std::sin(angle), 0.4F * turns * 6.28F * std::cos(angle), 2));
    const Vec3 across = glm::normalize(glm::cross(heading, Vec3(0, 0, 1)));
    stem.push_back({place, {across, glm::cross(heading, across), heading}, 0.012F * (1 - t)});
    plant.centre_lines.push_back({place, stem.back().radius});
  }
  add_tube(plant.mesh.bark, stem, 2, sides, 1);
  plant.branches.push_back(
      {-1, 0, {0, static_cast<std::uint32_t>(points)}, {0, static_cast<std::uint32_t>(plant.mesh.bark.triangles())}});
  return plant;
}

struct Hidden {
  double triangles = 0, ribbon = 0;  // m2, means over all directions
};

Hidden hidden(const Plant& plant, const BranchShape& shape) {
  Hidden sum;
  const auto& bark = plant.mesh.bark;
  const auto directions = spread_directions(60);
  for (const Vec3& direction : directions) {
    OrthoMask mesh(direction, {0, 0, 1}, 3.2F, 800), ribbon = mesh;
    for (std::size_t i = 0; i < bark.indices.size(); i += 3)
      mesh.triangle(bark.vertices[bark.indices[i]].position, bark.vertices[bark.indices[i + 1]].position,
                    bark.vertices[bark.indices[i + 2]].position);
    for (std::size_t i = 0; i + 1 < shape.line.size(); ++i)
      ribbon.line(shape.line[i].position, shape.line[i].radius, shape.line[i + 1].position, shape.line[i + 1].radius);
    sum.triangles += mesh.area_m2() / static_cast<double>(directions.size());
    sum.ribbon += ribbon.area_m2() / static_cast<double>(directions.size());
  }
  return sum;
}

float deviation(const CentrePoint& p, const CentrePoint& a, const CentrePoint& b) {
  const Vec3 along = b.position - a.position;
  const float t =
      std::clamp(glm::dot(p.position - a.position, along) / std::max(glm::dot(along, along), 1e-30F), 0.0F, 1.0F);
  return glm::length(p.position - glm::mix(a.position, b.position, t)) +
         std::abs(p.radius - glm::mix(a.radius, b.radius, t));
}

bool keeps(const std::vector<CentrePoint>& line, const std::vector<std::uint32_t>& kept, float tolerance) {
  for (std::size_t k = 0; k + 1 < kept.size(); ++k)
    for (std::uint32_t i = kept[k] + 1; i < kept[k + 1]; ++i)
      if (deviation(line[i], line[kept[k]], line[kept[k + 1]]) > tolerance) return false;
  return kept.front() == 0 && kept.back() + 1 == line.size();
}

}  // namespace

TEST_CASE("a ribbon hides what its branch hid") {
  // The open foot, in a plant inside the parent, hides radius / length more: 0.6 per cent. The rest is the raster.
  constexpr double kTolerance = 0.015;
  for (const int sides : {3, 4, 6, 16}) {
    INFO(sides << " sides");
    Plant straight;
    add_straight_branch(straight, -1, {0, 0, 0}, {0.5F, 0.3F, 1.8F}, 0.012F, 5, sides);
    for (const Plant& plant : {straight, curly_plant(24, sides, 0.7F)}) {
      const BranchShape shape = branch_shape(plant, plant.branches[0]);
      const Hidden area = hidden(plant, shape);
      CHECK(area.ribbon == Approx(area.triangles).epsilon(kTolerance));
      CHECK(static_cast<double>(shape.area_m2) == Approx(area.ribbon).epsilon(kTolerance));
    }
  }
}

TEST_CASE("a centre line keeps the fewest points within the tolerance") {
  Random random(5);
  for (int round = 0; round < 200; ++round) {
    std::vector<CentrePoint> line;
    const std::size_t size = 2 + random.bits() % 8;
    for (std::size_t i = 0; i < size; ++i)
      line.push_back({{random.spread(0.3F), random.spread(0.3F), static_cast<float>(i)}, random.uniform() * 0.1F});
    const float tolerance = 0.6F * random.uniform();
    const auto kept = fewest_points(line, tolerance);
    CHECK(keeps(line, kept, tolerance + 1e-6F));
    std::size_t fewest = size;
    for (std::uint32_t set = 0; set < (1U << size); ++set) {
      std::vector<std::uint32_t> some;
      for (std::uint32_t i = 0; i < size; ++i)
        if (set >> i & 1 || i == 0 || i + 1 == size) some.push_back(i);
      if (keeps(line, some, tolerance - 1e-6F)) fewest = std::min(fewest, some.size());
    }
    CHECK(kept.size() <= fewest);
  }
}

TEST_CASE("a straight line has two points and a long one is split in linear time") {
  std::vector<CentrePoint> line;
  for (int i = 0; i <= 40; ++i) line.push_back({{0, 0, static_cast<float>(i)}, 1 - static_cast<float>(i) / 40});
  CHECK(fewest_points(line, 1e-4F) == std::vector<std::uint32_t>{0, 40});
  for (int i = 41; i < 100'000; ++i) line.push_back({{0, 0, static_cast<float>(i)}, 0});
  CHECK(fewest_points(line, 1e-4F).size() <= 2 + line.size() / 60);
  line.assign(50, {{1, 2, 3}, 0.1F});
  CHECK(fewest_points(line, 0).size() == 2);
}

TEST_CASE("a branch without centre line is a line between its farthest corners") {
  Plant plant;
  add_straight_branch(plant, -1, {0, 0, 0}, {0, 0, 2}, 0.02F, 4, 6);
  plant.branches[0].line = {};
  const BranchShape shape = branch_shape(plant, plant.branches[0]);
  REQUIRE(shape.line.size() == 2);
  CHECK(glm::length(shape.line[1].position - shape.line[0].position) == Approx(2).epsilon(0.01));
  CHECK(shape.width_m >= 0.036F);  // a corner is nearly so far from the line through another and the tip
  const Hidden area = hidden(plant, shape);
  CHECK(area.ribbon == Approx(area.triangles).epsilon(0.02));
}

TEST_CASE("a branch of nothing has no line and one without triangles keeps its own") {
  Plant plant;
  plant.branches.push_back({});
  CHECK(branch_shape(plant, plant.branches[0]).line.empty());
  plant.centre_lines = {{{0, 0, 0}, 0.2F}, {{0, 0, 3}, 0.1F}};
  plant.branches[0].line = {0, 2};
  const BranchShape shape = branch_shape(plant, plant.branches[0]);
  REQUIRE(shape.line.size() == 2);
  CHECK(shape.line[0].radius == Approx(0.2F));
  CHECK(shape.line[1].radius == Approx(0.1F));
  CHECK(shape.length_m == 3);
  CHECK(shape.width_m == Approx(0.4F));
  CHECK(shape.area_m2 == Approx(3.14159 / 4 * 3 * 0.3));
}

}  // namespace manzana::foliage

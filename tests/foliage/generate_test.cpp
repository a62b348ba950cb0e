#include "foliage/generate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "foliage/import/species.h"
#include "foliage/leaf_image.h"
#include "foliage/random.h"
#include "tests/foliage/plant_checks.h"

using namespace manzana;
using namespace manzana::foliage;

namespace {

/// As shares of the plant's size: height, and distance from the axis.
Vec3 scaled(const Vec3& p, const PlantSize& size) { return p / Vec3(size.radius, size.radius, size.height); }

/// Largest distance from the axis of leaf vertices with z in [low, high), all scaled; 0 without any.
float crown_radius(const Plant& plant, float low, float high) {
  const PlantSize size = measure(plant.mesh);
  float r = 0;
  for (const MeshVertex& v : plant.mesh.leaves.vertices) {
    const Vec3 p = scaled(v.position, size);
    if (p.z >= low && p.z < high) r = std::max(r, radius(p));
  }
  return r;
}

float lowest_leaf(const Plant& plant) {
  const PlantSize size = measure(plant.mesh);
  float z = 1;
  for (const MeshVertex& v : plant.mesh.leaves.vertices) z = std::min(z, scaled(v.position, size).z);
  return z;
}

/// Of bark corners: the lowest, and the farthest from the axis below the ground; scaled.
struct Foot {
  float lowest = 1, off_axis = 0;
  void add(const Vec3& p) {
    lowest = std::min(lowest, p.z);
    if (p.z < 0) off_axis = std::max(off_axis, radius(p));
  }
};

void check_foot(const Foot& foot) {
  CHECK(foot.lowest < 0);
  CHECK(foot.lowest > -0.06F);
  CHECK(foot.off_axis < 0.2F);
}

}  // namespace

TEST_CASE("generated plants keep what plant.h and prepared_plant.h promise, for all species and several seeds") {
  for (const std::string_view species : kSpeciesNames) {
    for (const std::uint64_t seed : {1, 2, 77}) {
      INFO(species << " seed " << seed);
      const Plant plant = grow_plant(builtin_species(species), seed);
      check_plant(plant);
      const std::size_t triangles = plant.mesh.bark.triangles() + plant.mesh.leaves.triangles();
      CHECK(triangles >= 1800);
      CHECK(triangles <= 20'000);
      CHECK(plant.mesh.bark.triangles() > 0);
    }
  }
}

TEST_CASE("grown plants have branches after their parents and runs in order that cover all triangles") {
  for (const std::string_view species : kSpeciesNames) {
    for (const std::uint64_t seed : {1, 2, 77}) {
      INFO(species << " seed " << seed);
      const Plant plant = grow_plant(builtin_species(species), seed);
      check_runs(plant);
      bool carried = true;
      for (const Terminal& t : plant.terminals) carried = carried && t.branch >= 0;
      CHECK(carried);
      CHECK(plant.branches.front().parent == -1);
      CHECK(std::count_if(plant.branches.begin(), plant.branches.end(), [](auto& b) { return b.parent < 0; }) == 1);
    }
  }
}

TEST_CASE("a stem starts on its parent, and a leaf on its branch") {
  for (const std::string_view species : kSpeciesNames) {
    const Plant plant = grow_plant(builtin_species(species), 6);
    const auto lies_on = [&](const Vec3& p, const Branch& b) {
      float best = 1e9F;
      for (std::uint32_t i = b.line.first; i + 1 < b.line.last; ++i) {
        const Vec3 foot = plant.centre_lines[i].position, along = plant.centre_lines[i + 1].position - foot;
        const float t = std::clamp(glm::dot(p - foot, along) / glm::dot(along, along), 0.0F, 1.0F);
        best = std::min(best, glm::length(p - foot - along * t));
      }
      return best < 1e-3F;
    };
    bool stems_on = true, leaves_on = true;
    for (const Branch& b : plant.branches)
      if (b.parent >= 0)
        stems_on = stems_on && lies_on(plant.centre_lines[b.line.first].position,
                                       plant.branches[static_cast<std::size_t>(b.parent)]);
    for (const Terminal& t : plant.terminals) {
      const auto corner = [&](int i) {
        return plant.mesh.leaves.vertices[plant.mesh.leaves.indices[3 * t.triangles.first + static_cast<unsigned>(i)]];
      };
      const Vec3 foot = (corner(0).position + corner(1).position) * 0.5F;
      leaves_on = leaves_on && lies_on(foot, plant.branches[static_cast<std::size_t>(t.branch)]);
    }
    INFO(species);
    CHECK(stems_on);
    CHECK(leaves_on);
  }
}

TEST_CASE("a seed gives the same bytes, another seed others") {
  for (const std::string_view name : kSpeciesNames) {
    const SpeciesParams species = builtin_species(name);
    CHECK(fnv(grow_plant(species, 3)) == fnv(grow_plant(species, 3)));
    CHECK(fnv(grow_plant(species, 3)) != fnv(grow_plant(species, 4)));
  }
}

TEST_CASE("the counter hash is splitmix64's") {
  CHECK(foliage::hash(0) == 0xe220a8397b1dcdafULL);  // the first output for seed 0
}

TEST_CASE("species look like themselves") {
  for (const std::uint64_t seed : {1, 2, 3}) {
    INFO("seed " << seed);
    const Plant conifer = grow_plant(builtin_species("conifer"), seed);
    CHECK(lowest_leaf(conifer) < 0.15F);
    CHECK(crown_radius(conifer, 0.1F, 0.3F) > 1.4F * crown_radius(conifer, 0.75F, 0.95F));
    CHECK(measure(conifer.mesh).height > 2.5F * measure(conifer.mesh).radius);
    const Plant broadleaf = grow_plant(builtin_species("broadleaf"), seed);
    CHECK(lowest_leaf(broadleaf) > 0.08F);
    CHECK(crown_radius(broadleaf, 0.45F, 0.75F) > crown_radius(broadleaf, 0.9F, 1.01F));
    const Plant shrub = grow_plant(builtin_species("shrub"), seed);
    CHECK(lowest_leaf(shrub) < 0.15F);
    CHECK(measure(shrub.mesh).height < 4);
  }
}

TEST_CASE("trunks stand on the axis and reach into the ground") {
  for (const char* species : {"broadleaf", "conifer"}) {
    const Plant plant = grow_plant(builtin_species(species), 9);
    const PlantSize size = measure(plant.mesh);
    Foot grown;
    for (const MeshVertex& v : plant.mesh.bark.vertices) grown.add(scaled(v.position, size));
    check_foot(grown);
    const PreparedPlant ready = prepared_blind(plant);
    for (const BranchLevel& level : ready.branch_levels) {
      Foot drawn;
      for (std::uint32_t q = level.quads.first; q < level.quads.last; ++q)
        for (const PlantQuad::Corner& c : ready.bark[q].corners) drawn.add(scaled(c.position, size));
      INFO(species << " level of " << level.quads.size() << " quads");
      check_foot(drawn);
    }
  }
}

TEST_CASE("inner leaves are darker than outer ones") {
  const Plant plant = grow_plant(builtin_species("broadleaf"), 1);
  const PlantSize size = measure(plant.mesh);
  double inner = 0, outer = 0, inner_count = 0, outer_count = 0;
  for (const MeshVertex& v : plant.mesh.leaves.vertices) {
    const Vec3 p = scaled(v.position, size);
    if (p.z < 0.4F || p.z > 0.7F) continue;
    const bool in = radius(p) < 0.3F;
    (in ? inner : outer) += static_cast<double>(v.shade);
    (in ? inner_count : outer_count) += 1;
  }
  REQUIRE(inner_count > 0);
  REQUIRE(outer_count > 0);
  CHECK(inner / inner_count < 0.8 * outer / outer_count);
}

TEST_CASE("species differ in proportion, in the share of the trunk that is bare, and in colour") {
  struct Look {
    float slender, bare;
    Vec3 leaf, bark;
  };
  const auto mean = [](const Image& image) {
    Vec3 sum(0);
    float count = 0;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4)
      if (image.rgba[i + 3] >= 128)
        sum += Vec3(image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]) / 255.0F, count += 1;
    return sum / count;
  };
  std::vector<Look> looks;
  for (const std::string_view name : kSpeciesNames) {
    const Plant plant = grow_plant(builtin_species(name), 1);
    const PlantSize size = measure(plant.mesh);
    float lowest = size.height;
    for (const MeshVertex& v : plant.mesh.leaves.vertices) lowest = std::min(lowest, v.position.z);
    looks.push_back({size.height / size.radius, lowest / size.height, mean(plant.leaf_image), mean(plant.bark_image)});
  }
  for (std::size_t i = 0; i < looks.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      INFO(kSpeciesNames[i] << " and " << kSpeciesNames[k]);
      const float apart = std::abs(std::log(looks[i].slender / looks[k].slender)) +
                          std::abs(looks[i].bare - looks[k].bare) + glm::length(looks[i].leaf - looks[k].leaf) +
                          glm::length(looks[i].bark - looks[k].bark);
      CHECK(apart > 0.15F);
    }
  }
}

TEST_CASE("an apple tree bears fruit that hangs on branches, and shows it in its own corner of the image") {
  const SpeciesParams species = builtin_species("apple");
  const Plant plant = grow_plant(species, 1);
  const MeshPart& mesh = plant.mesh.leaves;
  std::size_t fruit = 0, leaves_below = 0, uv_wrong = 0;
  for (const Terminal& t : plant.terminals) {
    const bool is_fruit = t.organ == Organ::fruit;
    fruit += is_fruit;
    leaves_below += fruit > 0 && !is_fruit;
    for (std::uint32_t i = 3 * t.triangles.first; i < 3 * t.triangles.last; ++i) {
      const Vec2 uv = mesh.vertices[mesh.indices[i]].uv;
      uv_wrong += is_fruit ? uv.x > kOrganSide || uv.y < 1 - kOrganSide : uv.y > 1 - kOrganSide;
    }
  }
  CHECK(fruit > 50);
  CHECK(leaves_below == 0);
  CHECK(uv_wrong == 0);
  int red = 0;
  for (std::size_t y = 192; y < 256; ++y) {
    for (std::size_t x = 0; x < 256; ++x) {
      const std::uint8_t* p = &plant.leaf_image.rgba[4 * (y * 256 + x)];
      red += p[3] >= 128 && p[0] > 2 * p[1];
      if (x > 64) CHECK_FALSE(p[3] >= 128);
    }
  }
  CHECK(red > 1000);
}

TEST_CASE("parameters that cannot be drawn are refused") {
  const auto refused = [](auto&& change) {
    SpeciesParams species = builtin_species("broadleaf");
    change(species);
    CHECK_THROWS_AS(grow_plant(species, 1), std::invalid_argument);
  };
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
  refused([&](SpeciesParams& s) { s.scale = nan; });
  refused([&](SpeciesParams& s) { s.ratio_power = infinite; });
  refused([&](SpeciesParams& s) { s.stems[2].down_angle = nan; });
  refused([&](SpeciesParams& s) { s.leaf_scale_x = -1; });
  refused([&](SpeciesParams& s) { s.stems[1].curve_res = 0; });
  refused([&](SpeciesParams& s) { s.levels = 5; });
  refused([&](SpeciesParams& s) { s.shape = 8; });
  refused([&](SpeciesParams& s) { s.stems[0].length = 0; });
  refused([&](SpeciesParams& s) { s.leaf_shape = "square"; });
  refused([&](SpeciesParams& s) { s.organ = "thorn"; });
  refused([&](SpeciesParams& s) { s.organ = "fruit", s.organs = -1; });
  refused([&](SpeciesParams& s) { s.leaves = 10'000; });                                       // too many vertices
  refused([&](SpeciesParams& s) { s.stems[1].seg_splits = 10, s.stems[1].curve_res = 100; });  // splits explode
}

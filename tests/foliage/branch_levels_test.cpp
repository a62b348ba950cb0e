#include "foliage/branch_levels.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <limits>
#include <set>

#include "foliage/generate.h"
#include "foliage/import/gltf_plant.h"
#include "foliage/import/species.h"
#include "ortho_mask.h"
#include "tests/support/data.h"
#include "tiny_plants.h"

namespace manzana::foliage {
namespace {

PreparedPlant prepared(const Plant& plant, const PrepareOptions& options = {}) {
  PreparedPlant ready;
  prepare_branches(plant, options, ready);
  return ready;
}

std::vector<Plant> some_plants() {
  std::vector<Plant> plants{spiral_plant(20), Plant{}};
  for (const char* species : {"broadleaf", "conifer", "shrub"})
    plants.push_back(grow_plant(builtin_species(species), 5));
  return plants;
}

std::uint32_t next_branches(const PreparedPlant& ready, std::size_t l) {
  return l + 1 < ready.branch_levels.size() ? ready.branch_levels[l + 1].branches : 0;
}

/// The rows of the branches that have lines from `first` on.
std::set<std::uint32_t> rows_of_lines(const PreparedPlant& ready, std::uint32_t first) {
  std::set<std::uint32_t> rows;
  for (std::size_t i = first; i < ready.lines.size(); ++i) rows.insert(ready.lines[i].branch);
  return rows;
}

/// Square metres, mean over views from all sides: a single tube of three sides is wide from one and narrow from
/// another.
double hidden(const PreparedPlant& ready, std::size_t level, float t, float height) {
  double sum = 0;
  for (int view = 0; view < 8; ++view) {
    const float angle = 0.3F + 0.785F * static_cast<float>(view), rise = 0.2F * static_cast<float>(view % 3);
    OrthoMask mask({std::cos(angle) * std::cos(rise), std::sin(angle) * std::cos(rise), std::sin(rise)},
                   {0, 0, 0.5F * height}, 1.6F * height, 800);
    const BranchStep step = branch_step(ready, level, t);
    for (std::uint32_t i = 0; i < step.quads; ++i) mask.quad(ready.bark[ready.branch_levels[level].quads.first + i]);
    for (std::size_t i = step.first_line; i < ready.lines.size(); ++i) mask.line(ready.lines[i]);
    sum += mask.area_m2() / 8;
  }
  return sum;
}

}  // namespace

TEST_CASE("each step of a level has one branch more as mesh and one less as lines") {
  for (const Plant& plant : some_plants()) {
    const PreparedPlant ready = prepared(plant);
    for (std::size_t l = 0; l < ready.branch_levels.size(); ++l) {
      const BranchLevel& level = ready.branch_levels[l];
      REQUIRE(level.steps.size() == level.branches - next_branches(ready, l) + 1);
      for (std::uint32_t i = level.steps.first; i < level.steps.last; ++i) {
        const BranchStep& step = ready.branch_steps[i];
        const std::size_t as_mesh = next_branches(ready, l) + i - level.steps.first;
        CHECK(rows_of_lines(ready, step.first_line).size() == plant.branches.size() - as_mesh);
        if (i > level.steps.first) CHECK(step.quads > ready.branch_steps[i - 1].quads);
      }
      const BranchStep all = branch_step(ready, l, 0);
      CHECK(all.quads == level.quads.size());
      CHECK(all.first_line == level.first_line);
      for (const float nothing : {-1.0F, std::numeric_limits<float>::quiet_NaN()})
        CHECK(branch_step(ready, l, nothing).quads == all.quads);
      CHECK(branch_step(ready, l, 1).first_line == branch_step(ready, l, 2).first_line);
      CHECK(branch_step(ready, l, 1).first_line ==
            (l + 1 < ready.branch_levels.size() ? ready.branch_levels[l + 1].first_line : 0));
    }
  }
}

TEST_CASE("levels are nested and grow coarser and say their widest line") {
  for (const Plant& plant : some_plants()) {
    const PreparedPlant ready = prepared(plant);
    REQUIRE(!ready.branch_levels.empty());
    CHECK(ready.branch_levels[0].branches == plant.branches.size());
    CHECK(ready.branch_levels[0].first_line == ready.lines.size());
    CHECK(ready.branch_levels[0].error_m == 0);
    CHECK(ready.branch_levels[0].mesh_error_m == 0);
    CHECK(ready.branch_levels.back().quads.last == ready.bark.size());
    for (std::size_t l = 1; l < ready.branch_levels.size(); ++l) {
      const BranchLevel &level = ready.branch_levels[l], &finer = ready.branch_levels[l - 1];
      CHECK(level.branches < finer.branches);
      CHECK(level.quads.first == finer.quads.last);
      CHECK(level.quads.size() < finer.quads.size());
      CHECK(level.error_m >= finer.error_m);
      float widest = 0;
      for (const std::uint32_t row : rows_of_lines(ready, level.first_line))
        for (std::uint32_t i = plant.branches[row].line.first; i < plant.branches[row].line.last; ++i)
          widest = std::max(widest, 2 * plant.centre_lines[i].radius);
      CHECK(level.error_m == widest);
    }
  }
}

TEST_CASE("lines of a branch are together and those between two levels are in random order") {
  const Plant plant = spiral_plant(60);
  const PreparedPlant ready = prepared(plant), again = prepared(plant);
  PrepareOptions other_seed;
  other_seed.seed = 2;
  const auto rows = [](const PreparedPlant& p) {
    std::vector<std::uint32_t> out;
    for (const LineSegment& line : p.lines) out.push_back(line.branch);
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  };
  CHECK(rows(ready).size() == plant.branches.size());
  CHECK(rows(ready) == rows(again));
  CHECK(rows(ready) != rows(prepared(plant, other_seed)));
  REQUIRE(ready.bark.size() == again.bark.size());
  CHECK(std::memcmp(ready.bark.data(), again.bark.data(), ready.bark.size() * sizeof(PlantQuad)) == 0);
  const BranchLevel& coarse = ready.branch_levels[1];
  std::vector<float> widths;
  for (std::size_t i = coarse.first_line; i < ready.lines.size(); ++i) widths.push_back(ready.lines[i].radius_a);
  CHECK(!std::is_sorted(widths.rbegin(), widths.rend()));
}

TEST_CASE("all levels and the steps between them hide what the whole mesh hides") {
  constexpr double kMostOff = 0.035;  // eight views of few thick tubes are no mean of all views; leaves hide most of it
  for (const char* species : {"broadleaf", "conifer", "shrub"}) {
    const PreparedPlant ready = prepared(grow_plant(builtin_species(species), 5));
    const double all = hidden(ready, 0, 0, 8);
    for (std::size_t l = 0; l < ready.branch_levels.size(); ++l)
      for (const float t : {0.0F, 0.3F, 0.7F, 1.0F}) {
        INFO(species << " level " << l << " t " << t);
        CHECK(hidden(ready, l, t, 8) == Approx(all).epsilon(kMostOff));
      }
  }
}

TEST_CASE("real trees: every level hides what the whole mesh hides") {
  constexpr double kMostOff = 0.01;  // measured 0.004
  for (const char* tree : {"ash_medium", "aspen_medium_modelled", "oak_dense", "oak_medium", "pine_medium"}) {
    const auto file = data_file(std::string("trees/") + tree + ".glb");
    if (!file) return;
    const Plant plant = read_plant(*file);
    const PreparedPlant ready = prepared(plant);
    const float height = measure(plant.mesh).height;
    REQUIRE(ready.branch_levels.size() >= 4);
    const double all = hidden(ready, 0, 0, height);
    for (std::size_t l = 1; l < ready.branch_levels.size(); ++l) {
      INFO(tree << " level " << l);
      CHECK(hidden(ready, l, 0, height) == Approx(all).epsilon(kMostOff));
      CHECK(hidden(ready, l, 0.5F, height) == Approx(all).epsilon(kMostOff));
    }
  }
}

TEST_CASE("a plant of one branch and one without triangles have one level") {
  CHECK(prepared(spiral_plant(0)).branch_levels.size() == 1);
  Plant wire;
  wire.centre_lines = {{{0, 0, 0}, 0.1F}, {{0, 0, 1}, 0.1F}};
  wire.branches.push_back({-1, 0, {0, 2}, {0, 0}});
  const PreparedPlant ready = prepared(wire);
  REQUIRE(ready.branch_levels.size() == 1);
  CHECK(ready.bark.empty());
  CHECK(ready.lines.size() == 1);
}

}  // namespace manzana::foliage

// An ecosystem as a scene: every plant once, where its files place it, and found by the tree.
#include <catch2/catch.hpp>
#include <fstream>
#include <map>

#include "culling/baselines/exact.h"
#include "scenegraph/import/ecosystem_features.h"
#include "scenegraph/import/import.h"
#include "scenegraph/visible.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

using namespace manzana;

namespace {

std::filesystem::path write(const TemporaryFolder& folder, const char* name, const char* text) {
  std::ofstream(folder.path() / name) << text;
  return folder.path() / name;
}

foliage::Ecosystem meadows() {
  const TemporaryFolder folder;
  write(folder, "herb.json", "{}");
  write(folder, "grass.json", "{}");
  write(folder, "clump.json", R"({"instances": [{"plant": "herb.json", "scale": 2, "turn": 30},
    {"plant": "grass.json", "scatter": {"count": 30, "radius": 1.5, "seed": 3}}]})");
  return foliage::read_ecosystem(write(folder, "all.json", R"({"instances": [
    {"ecosystem": "clump.json", "scatter": {"count": 80, "radius": 200, "seed": 1}},
    {"plant": "herb.json", "at": [300, -20, 1.5], "turn": 350, "scale": 0.5}]})"));
}

std::vector<foliage::PreparedPlant> plants() {
  std::vector<foliage::PreparedPlant> two(2);
  two[0].height_m = 0.4F, two[0].crown_radius_m = 0.1F;
  two[1].height_m = 0.2F, two[1].crown_radius_m = 0.15F;
  return two;
}

/// In millimetres, with the model.
using Key = std::array<std::int64_t, 4>;
Key key_of(const Vec3d& p, std::int64_t plant) {
  return {std::lround(p.x * 100), std::lround(p.y * 100), std::lround(p.z * 100), plant};
}

}  // namespace

TEST_CASE("ecosystem: each plant stands in the scene where its files place it") {
  const foliage::Ecosystem ecosystem = meadows();
  const Imported made = build_scene(ecosystem_features(ecosystem, plants()), {}, {});
  const Scene& scene = made.scene;
  CHECK(made.issues.empty());
  REQUIRE(scene.trees.instances.size() == 80 * 31 + 1);
  std::map<Key, int> expected, found;
  each_plant(
      ecosystem, [](auto, auto&) { return true; },
      [&](std::uint32_t plant, const foliage::Placement& at) {
        const BlockFrame frame = block_frame(scene.frame, Vec2d(at.position));
        const Vec3d foot = frame.to_local(ground_point(scene.frame, frame, Vec2d(at.position), at.position.z));
        ++expected[key_of(foot, static_cast<std::int64_t>(kPlantSpecies + plant))];
      });
  for (const TreeInstance& tree : scene.trees.instances)
    ++found[key_of(scene.blocks[tree.block].to_local(Vec3d(tree.position)), tree.plant)];
  std::size_t moved = 0;
  for (const auto& [key, count] : expected) moved += found[key] == count ? 0 : 1;
  CHECK(moved < expected.size() / 100);  // those that a float rounds over a centimetre's border
  const auto lone = std::find_if(scene.trees.instances.begin(), scene.trees.instances.end(),
                                 [](const TreeInstance& t) { return t.position.z > 1; });
  REQUIRE(lone != scene.trees.instances.end());
  CHECK(lone->height_m == 0.2F);
  CHECK(lone->crown_radius_m == 0.05F);
  CHECK(lone->yaw == Approx(-10 * 3.14159265358979 / 180));
}

TEST_CASE("ecosystem: no plant that is in view is left out") {
  const Scene scene = build_scene(ecosystem_features(meadows(), plants()), {}, {}).scene;
  VisibleSets sets(scene);
  support::Random random(71);
  std::size_t in_view = 0, taken = 0;
  for (int k = 0; k < 60; ++k) {
    const Vec3d eye(random.within(-250, 250), random.within(-250, 250), random.within(0.2, 40));
    const Vec3d at(random.within(-250, 250), random.within(-250, 250), 0);
    const culling::View view = culling::look(eye, at - eye, {0, 0, 1}, 1, 1.5);
    find_visible(scene, view, Structure::bqr, sets);
    std::vector<bool> seen(scene.trees.table.size(), false);
    for (const culling::ObjectRun& run : sets.objects()) {
      const culling::ObjectRun rows = scene.trees.table.rows(run);
      for (std::uint32_t i = rows.first; i < rows.last; ++i) seen[i] = true, ++taken;
    }
    const culling::ExactView exact = make_exact(view);
    for (std::uint32_t i = 0; i < seen.size(); ++i) {
      const TreeInstance& tree = scene.trees.instances[i];
      const Vec3d foot = scene.blocks[tree.block].to_local(Vec3d(tree.position));
      if (!exactly_overlaps(exact, {foot, foot})) continue;
      ++in_view;
      CHECK(seen[i]);
    }
  }
  CHECK(in_view > 10'000);
  CHECK(taken < 2 * in_view);
}

TEST_CASE("ecosystem: more plants than a scene has room for are refused before they are placed") {
  const TemporaryFolder folder;
  write(folder, "herb.json", "{}");
  write(folder, "patch.json", R"({"instances": [{"plant": "herb.json", "scatter": {"count": 1000, "radius": 9}}]})");
  write(folder, "many.json",
        R"({"instances": [{"ecosystem": "patch.json", "scatter": {"count": 5000, "radius": 900}}]})");
  const foliage::Ecosystem many = foliage::read_ecosystem(folder.path() / "many.json");
  CHECK_THROWS_WITH(ecosystem_features(many, plants()), Catch::Contains("many.json: places 5005000 plants"));
}

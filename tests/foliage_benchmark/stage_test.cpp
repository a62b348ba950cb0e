// Plants on the stage: how large they are in the picture, and what a still camera sees twice.
#include <array>
#include <catch2/catch.hpp>
#include <numbers>

#include "apps/foliage_benchmark/errors.h"
#include "apps/foliage_benchmark/fixed_detail.h"
#include "apps/foliage_benchmark/forest.h"
#include "apps/foliage_benchmark/popping.h"
#include "apps/foliage_benchmark/sheet.h"
#include "apps/foliage_benchmark/stand_in.h"
#include "foliage/generate.h"
#include "foliage/import/species.h"
#include "foliage/prepare.h"
#include "gl/context.h"
#include "gl/error_log.h"
#include "tests/foliage/tiny_plants.h"

namespace manzana::foliage_benchmark {
namespace {

const std::vector<foliage::PreparedPlant>& shrub() {
  static const std::vector<foliage::PreparedPlant> plants = [] {
    std::vector<foliage::PreparedPlant> made{prepare(grow_plant(foliage::builtin_species("shrub"), 3))};
    made.front().name = "shrub";
    return made;
  }();
  return plants;
}

/// Rows between the lowest and the highest that the plant covers.
int rows_covered(const Picture& picture) {
  int low = picture.height, high = -1;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      if (picture.at(x, y).w > 0) {
        low = std::min(low, y);
        high = std::max(high, y);
      }
  return high - low + 1;
}

}  // namespace

TEST_CASE("stage: a plant is as high as it is asked to be and leaves a margin") {
  const gl::HeadlessContext context;
  gl::ErrorLog log;
  Stage stage(shrub(), sites_of(shrub()));
  stage.set_law(foliage::Law::full);
  const Extent extent = extent_of(shrub().front());
  for (const double height_px : {24.0, 96.0}) {
    const Shot shot = shot_of(extent, 0.3, 0.02, height_px);
    for (const Sampling sampling : {Sampling::fine, Sampling::product}) {
      const Picture picture = stage.draw({0, 1}, shot, {1, sampling});
      CHECK(picture.width == shot.width);
      const double expected = height_px * (extent.high - extent.low) / extent.nominal_height;
      CHECK(rows_covered(picture) == Approx(expected).epsilon(0.15).margin(3));
      for (int x = 0; x < picture.width; ++x) CHECK(picture.at(x, 4).w + picture.at(x, picture.height - 5).w == 0);
    }
  }
  CHECK(stage.shown().leaves == shrub().front().leaves.size());
  CHECK(log.messages().empty());
}

TEST_CASE("stage: the same shot twice is the same picture and half a pixel beside it is not") {
  const gl::HeadlessContext context;
  Stage stage(shrub(), sites_of(shrub()));
  stage.set_law(foliage::Law::ours);
  const Shot shot = shot_of(extent_of(shrub().front()), 1, 0.3, 48);
  const Picture once = stage.draw({0, 1}, shot, {});
  CHECK(image_error(once, stage.draw({0, 1}, shot, {})).psnr == 99);
  const ImageError beside = image_error(once, stage.draw({0, 1}, moved(shot, 0.5), {}));
  CHECK(beside.cover == Approx(1).epsilon(0.01));
  CHECK(beside.ssim < 0.99);
  const ImageError far = image_error(once, stage.draw({0, 1}, moved(shot, 4), {}));
  CHECK(far.ssim < beside.ssim);
}

TEST_CASE("stage: points and lines cover what leaves and branches do at the border of a wide picture too") {
  const gl::HeadlessContext context;
  const std::vector<foliage::PreparedPlant> oak{prepare(grow_plant(foliage::builtin_species("oak"), 1))};
  Stage stage(oak, sites_of(oak));
  const double height = static_cast<double>(oak.front().height_m);
  for (const double aside : {0.0, 0.55, 0.95}) {
    double full = 0, ours = 0;
    for (int side = 0; side < 6; ++side) {
      const double azimuth = side * std::numbers::pi / 3;
      const Vec3d to(std::cos(azimuth), std::sin(azimuth), 0), beside(to.y, -to.x, 0);
      Shot shot = screen_shot(Vec3d(0, 0, height / 2) - to * (8 * height), to - aside * beside, 200);
      shot.fine = 8;
      const auto cover = [&](foliage::Law law) {
        stage.set_law(law);
        double sum = 0;
        for (const Vec4& texel : stage.draw({0, 1}, shot, {}).texels) sum += static_cast<double>(texel.w);
        return sum;
      };
      full += cover(foliage::Law::full), ours += cover(foliage::Law::ours);
    }
    CAPTURE(aside, full, ours);
    CHECK(full > 100);
    CHECK(ours / full == Approx(1).margin(0.03));
  }
}

TEST_CASE("stage: samples that are drawn are those covered and those hidden") {
  const gl::HeadlessContext context;
  Stage stage(shrub(), sites_of(shrub(), 3));
  stage.set_law(foliage::Law::full);
  const Shot shot = shot_of(extent_of(shrub().front()), 1, 0.3, 64);
  const auto drawn = [&](std::uint32_t copies) {
    return static_cast<double>(stage.samples_drawn(std::array{foliage::Run{0, copies}}, shot, {}));
  };
  double covered = 0;
  for (const Vec4& texel : stage.draw({0, 1}, shot, {.sampling = Sampling::product}).texels)
    covered += kProductSamples * static_cast<double>(texel.w);
  CAPTURE(covered);
  CHECK(drawn(1) > 1.2 * covered);
  CHECK(drawn(1) < 10 * covered);
  CHECK(drawn(3) == Approx(3 * drawn(1)).epsilon(0.02));  // at the same place, each with thresholds of its own
}

TEST_CASE("errors: full detail has none and floors are the worse of two") {
  const gl::HeadlessContext context;
  const ErrorPlan plan{.heights = {32}, .views = 2, .settings = {{foliage::Law::full}, {foliage::Law::ours}}};
  double done = 0;
  const auto rows = measure_errors(shrub(), plan, [&](double now) {
    CHECK(now > done);
    done = now;
  });
  CHECK(done == 1);
  REQUIRE(rows.size() == 2 * (3 + 2 * 2));
  for (const ErrorRow& row : rows) {
    CHECK(row.plant == "shrub");
    if (row.law != "full") continue;
    CHECK(row.primitives == 2 * (row.bark + row.leaves + row.lines) + row.points);
    if (row.sampling == "fine") CHECK(row.psnr == 99);
  }
  const auto verdicts = judge(rows);
  REQUIRE(verdicts.size() == 6);  // full: moved, product, single, fine; ours: fine, product
  for (const Verdict& v : verdicts) {
    CHECK(v.floor_ssim == std::min(verdicts[0].ssim, verdicts[1].ssim));
    CHECK(v.floor_gmsd == std::max(verdicts[0].gmsd, verdicts[1].gmsd));
    if (v.law == "full" && v.sampling == "fine") CHECK(v.over.empty());
  }
}

TEST_CASE("unfaded: leaves are whole or not at all and parts are one or the other") {
  const foliage::PreparedPlant& plant = shrub().front();
  foliage::PlantTable table = foliage::make_plant_table(shrub());
  foliage::Detail faded = pruned(plant, 0.37);
  faded.fade = 0.3F;
  faded.point_level = 0.6F;
  const auto partial_leaves = [&](const foliage::Detail& detail) {
    table.details = same_everywhere(shrub(), [&](const PreparedPlant&) { return detail; });
    const auto sites = sites_of(shrub());
    const auto rows = rows_seen_from({0, -30, 2});
    const foliage::Run run{0, 1};
    foliage::Selection chosen;
    select(table, {sites, rows, {&run, 1}, 0.001}, chosen);
    int partial = 0;
    for (const foliage::Item& item : chosen.items)
      if (item.kind == foliage::glsl::kLeaves && item.count > 0)
        partial += (item.edge - static_cast<float>(item.count - 1)) / item.fade < 1 ? 1 : 0;
    return partial;
  };
  CHECK(partial_leaves(faded) > 0);
  CHECK(partial_leaves(unfaded(faded)) == 0);
  CHECK(unfaded(faded).share == Approx(faded.share * 0.85F));
  CHECK(unfaded(faded).point_level == 0);
}

TEST_CASE("popping: fading steps less in the mean and what does not fade is no better than itself") {
  const gl::HeadlessContext context;
  PopPlan plan{.heights = {16}, .range = 1.6};
  int pictures = 0;
  const auto popping = [&] {
    return measure_popping(
        shrub(), plan, [](double) {}, [&](const Popped& popped) { pictures += popped.sheet.width > 3 * 16 ? 1 : 0; });
  };
  const auto faded = popping();
  REQUIRE(faded.size() == 2);
  CHECK(pictures == 2);
  for (const PopRow& row : faded) {
    CHECK(row.frames > 90);
    CHECK(row.mean <= kMostPopping * row.unfaded_mean);
    CHECK(row.most <= 1);
  }
  CHECK(faded.front().unfaded_mean > 0.01);
  plan.change = unfaded;
  for (const PopRow& row : popping()) {
    CHECK(row.ratio_mean == 1);
    CHECK(row.ratio_strong == 1);
    CHECK(row.ratio_most == 1);
  }
}

TEST_CASE("stage: blades of grass cover the same as quads, as lines and as points") {
  const gl::HeadlessContext context;
  gl::ErrorLog log;
  std::vector<foliage::PreparedPlant> plants{prepare(foliage::leaves_on_ground(3000, 0.01F, 1))};
  Stage stage(plants, sites_of(plants));
  std::uint64_t lines = 0;
  for (const double height_px : {64.0, 32.0, 16.0, 8.0, 4.0}) {
    Shot shot = shot_of(extent_of(plants.front()), 0.7, 0.3, height_px);
    shot.fine = fine_samples(height_px, shot.width);
    stage.set_law(foliage::Law::full);
    const Picture full = stage.draw({0, 1}, shot, {1, Sampling::fine});
    stage.set_law(foliage::Law::ours);
    const Picture ours = stage.draw({0, 1}, shot, {1, Sampling::fine});
    lines = std::max(lines, stage.shown().lines);
    const ImageError error = image_error(full, ours);
    INFO(height_px << " px high: cover " << error.cover << " colour " << error.colour << " ssim " << error.ssim << ", "
                   << stage.shown().leaves << " quads, " << stage.shown().lines << " lines");
    CHECK(error.cover == Approx(1).epsilon(0.03));
    CHECK(error.colour < 0.01);
    CHECK(error.ssim > 0.84);
  }
  CHECK(lines > 0);
  CHECK(log.messages().empty());
}

TEST_CASE("stage: a window of a picture shows what the whole does there") {
  const gl::HeadlessContext context;
  const auto sites = make_forest(shrub(), 30, closed_spacing(shrub()), 2);
  Stage stage(shrub(), sites);
  const Shot whole = screen_shot({-9, 1, 3}, {1, 0, -0.3}, 90);
  for (const foliage::Law law : {foliage::Law::full, foliage::Law::ours}) {
    stage.set_law(law);
    const Shot part = window_of(whole, 40, 20, 60, 45);
    const Picture expected = cropped(stage.draw({0, 30}, whole, {}), {40, 20, 100, 65});
    const ImageError error = image_error(expected, stage.draw({0, 30}, part, {}));
    CHECK(covered(expected) > 500);
    CHECK(error.cover == Approx(1).margin(0.005));
    CHECK(error.ssim > 0.95);  // noise goes by the pixel of the window
  }
}

TEST_CASE("stage: all detail that lists have no room for at once is the same picture in parts") {
  const gl::HeadlessContext context;
  gl::ErrorLog log;
  const auto sites = make_forest(shrub(), 30, closed_spacing(shrub()), 2);
  const auto quads = static_cast<std::uint32_t>(shrub().front().leaves.size() + shrub().front().bark.size());
  Stage at_once(shrub(), sites), in_parts(shrub(), sites, {.quads = 4 * quads});
  const Shot shot = screen_shot({-9, 1, 3}, {1, 0, -0.3}, 90);
  for (Stage* stage : {&at_once, &in_parts}) stage->set_law(foliage::Law::full);
  const Picture expected = at_once.draw({0, 30}, shot, {}), seen = in_parts.draw({0, 30}, shot, {});
  CHECK(image_error(expected, seen).psnr == 99);
  CHECK(in_parts.shown().missing == 0);
  CHECK(in_parts.shown().leaves == at_once.shown().leaves);
  CHECK(log.messages().empty());
}

TEST_CASE("forest: blocks hold all trees, one after the other, near each other") {
  const double spacing = closed_spacing(shrub());
  const auto sites = make_forest(shrub(), 100, spacing, 2), ordered = in_blocks(sites, 3 * spacing);
  REQUIRE(ordered.size() == sites.size());
  CHECK(ordered.back().block > 8);
  for (std::size_t i = 1; i < ordered.size(); ++i) {
    const auto &a = ordered[i - 1], &b = ordered[i];
    CHECK((b.block == a.block || b.block == a.block + 1));
    if (b.block == a.block) CHECK(static_cast<double>(glm::distance(a.position, b.position)) < 3 * spacing * 1.5);
  }
}

TEST_CASE("stage: a tree twice as slender or stout as by nature covers what it should from all sides") {
  const gl::HeadlessContext context;
  const std::vector<foliage::PreparedPlant> plants{prepare(grown_dense("oak", 60'000), {.visibility_side = 0})};
  const foliage::PreparedPlant& plant = plants.front();
  for (const float slender : {0.5F, 2.0F}) {
    const std::vector<foliage::TreeSite> sites{
        foliage::make_site(plant, 0, slender * plant.height_m, plant.crown_radius_m, 0.3F, 1)};
    Stage stage(plants, sites);
    for (const double elevation : {0.0, 0.8, 1.5}) {
      const Shot shot = shot_of(extent_of(plant), 0.3, elevation, 24);
      stage.set_law(foliage::Law::full);
      const Picture full = stage.draw({0, 1}, shot, {1, Sampling::fine});
      stage.set_law(foliage::Law::ours);
      const ImageError error = image_error(full, stage.draw({0, 1}, shot, {1, Sampling::fine}));
      INFO("height " << slender << " elevation " << elevation << " points " << stage.shown().points);
      CHECK(stage.shown().points > 0);
      CHECK(error.cover == Approx(1).epsilon(0.06));
    }
  }
}

}  // namespace manzana::foliage_benchmark

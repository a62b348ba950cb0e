// Many plants at once: the field of Deussen 2005, and forests. All detail is drawn of a part of them, and scaled.
#include <algorithm>
#include <cmath>

#include "apps/common/clock.h"
#include "apps/common/markdown.h"
#include "apps/common/quantile.h"
#include "apps/foliage_benchmark/forest.h"
#include "apps/foliage_benchmark/portrait.h"
#include "apps/foliage_benchmark/stand_in.h"
#include "apps/foliage_benchmark/times_md.h"
#include "foliage/import/turtle.h"
#include "foliage/prepare.h"
#include "foliage_benchmark_parts_plants.h"

namespace manzana::foliage_benchmark {
namespace {

using foliage::Law;
using foliage::PreparedPlant;

constexpr const char* kField = "Deussen 2005, field";
constexpr const char* kPoints = "Deussen 2005, figure 10.17";
constexpr const char* kForest = "forest";
constexpr const char* kPath = "forest, path";
constexpr const char* kHerb = "Deussen 2005, figure 10.14";
constexpr std::uint32_t kFieldPlants = 1500, kFieldTriangles = 12'000'000;  // [Deussen 2005, figure 10.14]

std::vector<Extent> extents_of(std::span<const PreparedPlant> plants) {
  std::vector<Extent> extents;
  std::transform(plants.begin(), plants.end(), std::back_inserter(extents), extent_of);
  return extents;
}

std::uint64_t covered(const Picture& picture) {
  return static_cast<std::uint64_t>(
      std::count_if(picture.texels.begin(), picture.texels.end(), [](const Vec4& t) { return t.w > 0; }));
}

double widest(std::span<const PreparedPlant> plants) {
  float radius = 0;
  for (const PreparedPlant& plant : plants) radius = std::max(radius, plant.crown_radius_m);
  return static_cast<double>(radius);
}

/// Plants on the ground, from shot to shot.
class Scene {
 public:
  Scene(const Effort& effort, std::span<const PreparedPlant> plants, const std::vector<foliage::TreeSite>& sites)
      : most_full_quads_(effort.quick ? 4e4 : 2e5),
        extents_(extents_of(plants)),
        stage_(plants, sites, {.quads = 1U << 22}) {}

  /// Ours with all plants in view, against all detail of some, times what they stand for.
  void measure(const Shot& shot, double seconds, TimeRow& row) {
    const auto all = in_view(stage_, extents_, shot);
    const std::uint64_t primitives = full_primitives(stage_, all);
    const auto every = std::max<std::uint32_t>(
        1, static_cast<std::uint32_t>(std::ceil(static_cast<double>(primitives) / 2 / most_full_quads_)));
    const auto some = in_view(stage_, extents_, shot, every);
    stage_.set_law(Law::ours);
    row.covered_px = static_cast<double>(covered(stage_.draw(all, shot, kHow)));
    set_shown(stage_.shown(), row);
    row.trees = trees_of(all);
    row.reference_primitives = primitives;
    const auto ours = [&] {
      stage_.set_law(Law::ours);
      stage_.draw_only(all, shot, kHow);
    };
    const auto full = [&] {
      stage_.set_law(Law::full);
      stage_.draw_only(some, shot, kHow);
    };
    PairTimes times = time_pairs(ours, full, seconds, 1);
    const double stands_for = static_cast<double>(primitives) /
                              static_cast<double>(std::max<std::uint64_t>(1, full_primitives(stage_, some)));
    times.reference_ms *= stands_for;
    times.ratio *= stands_for;
    times.ratio_lo *= stands_for;
    times.ratio_hi *= stands_for;
    set_times(times, row);
  }

  /// Every frame of a path, the least of so many times each: what is left is the frame's own.
  void fly(std::span<const Shot> path, int times, TimeRow& row) {
    std::vector<double> frames_ms;
    stage_.set_law(Law::ours);
    for (const Shot& shot : path) {
      const auto all = in_view(stage_, extents_, shot);
      double least = 1e9;
      for (int round = 0; round < times; ++round) {
        const auto start = apps::Clock::now();
        stage_.draw_only(all, shot, kHow);
        least = std::min(least, apps::us_since(start) / 1000);
      }
      frames_ms.push_back(least);
    }
    row.ms = apps::quantile(frames_ms, 0.5);
    row.ms_99 = apps::quantile(frames_ms, 0.99);
    row.trees = stage_.sites().size();
  }

 private:
  static constexpr HowDrawn kHow{1, Sampling::product};
  double most_full_quads_;  // that are drawn at once with all detail
  std::vector<Extent> extents_;
  Stage stage_;
};

/// [Deussen 2005, equation 10.5] c_p A / d'^2 points, each d' wide.
Detail points_of(const PreparedPlant& plant, double c, double d_m) {
  Detail detail = leaves_as_points(plant, c);
  const double most = static_cast<double>(detail.points);
  const double wanted = std::clamp(c * static_cast<double>(plant.point_levels.front().area) / (d_m * d_m), 1.0, most);
  detail.points = static_cast<float>(wanted);
  detail.point_gain = static_cast<float>(c / wanted);
  return detail;
}

void add_point_sweep(const Effort& effort, const PreparedPlant& plant, Times& times) {
  constexpr double kHeightPx = 64;
  if (plant.point_levels.empty()) return;
  Lazy<Portrait> portrait([&] { return Portrait(plant, kHeightPx); });
  const double pixel_m = static_cast<double>(plant.height_m) / kHeightPx;
  for (const double size_px : {1.0, 1.5, 2.0, 3.0}) {
    for (const double c : {1.0, 1.2, 1.5, 2.0, 3.0}) {
      if (effort.quick && c != 1.2 && size_px != 1.5) continue;
      times.add({.table = kPoints,
                 .plant = plant.name,
                 .way = "c_p " + apps::digits3(c) + ", points of " + apps::digits3(size_px) + " px",
                 .reference = "all detail"},
                [&](TimeRow& row) { portrait->look(points_of(plant, c, size_px * pixel_m), all_detail(plant), row); });
    }
  }
}

PreparedPlant herb() {
  PreparedPlant plant = prepare(grow_plant(foliage::parse_lsystems(plants::herb_json).front()), {.visibility_side = 0});
  plant.name = "herb";
  return plant;
}

/// A small plant's stems as lines against its triangles, and as ours has it, from near to far.
void add_herb(Times& times) {
  Lazy<PreparedPlant> plant(herb);
  for (const double height_px : {256.0, 128.0, 64.0, 32.0, 16.0}) {
    Lazy<Portrait> portrait([&] { return Portrait(*plant, height_px); });
    const std::string at = " at " + std::to_string(std::lround(height_px)) + " px";
    const auto add = [&](const std::string& way, const std::function<Detail(const PreparedPlant&)>& detail) {
      times.add({.table = kHerb, .plant = "herb", .way = way + at, .reference = "all detail"}, [&](TimeRow& row) {
        portrait->look(detail(*plant), all_detail(*plant), row);
        set_shown(portrait->stage().shown(), row);
      });
    };
    add("stems as lines", [](const PreparedPlant& p) {
      return at_branch_level(p, static_cast<std::uint32_t>(p.branch_levels.size()), true);
    });
    add("ours", [&](const PreparedPlant& p) {
      const double error_m = static_cast<double>(p.height_m) / height_px;
      foliage::PlantTable table = foliage::make_plant_table({&p, 1});
      table.details = make_details({&p, 1}, Law::ours);
      return detail_at(table, 0, static_cast<float>(error_m * error_m));
    });
  }
}

/// A field of it has as many triangles as the source's.
PreparedPlant plant_of_the_field() {
  PreparedPlant plant = prepare(grown_to("broadleaf", 1.0 * kFieldTriangles / kFieldPlants), {.visibility_side = 0});
  plant.name = "broadleaf";
  return plant;
}

/// Over the forest, then down into it.
std::vector<Shot> forest_path(double half_m, int frames, int height_px, const PreparedPlant& plant) {
  std::vector<Shot> shots;
  for (int i = 0; i < frames; ++i) {
    const double t = frames > 1 ? static_cast<double>(i) / (frames - 1) : 0, top = static_cast<double>(plant.height_m);
    const double height = t < 0.5 ? top * (6 - 8 * t) : std::max(1.7, top * (4 - 6 * t));
    const Vec3d eye(-half_m * (1.1 - 1.2 * t), half_m * 0.1 * std::sin(6 * t), height);
    shots.push_back(screen_shot(eye, {1, 0.2 * std::cos(5 * t), -0.35 + 0.4 * t}, height_px));
  }
  return shots;
}

std::string forest_summary(std::span<const TimeRow> rows) {
  std::vector<double> fewer, per_pixel, ratios;
  double spread = 0;
  for (const TimeRow& row : rows) {
    if (row.table == kPath && row.ms) spread = *row.ms_99 / *row.ms;
    if (row.table != kForest || !row.primitives) continue;
    const double drawn = std::max(1.0, static_cast<double>(*row.primitives));
    fewer.push_back(static_cast<double>(*row.reference_primitives) / drawn);
    per_pixel.push_back(drawn / std::max(1.0, *row.covered_px));
    ratios.push_back(*row.ratio);
  }
  if (fewer.empty()) return {};
  const auto least = [](const std::vector<double>& v) { return apps::digits3(*std::min_element(v.begin(), v.end())); };
  const auto most = [](const std::vector<double>& v) { return apps::digits3(*std::max_element(v.begin(), v.end())); };
  return "Fewer primitives than all detail: " + least(fewer) + " times at least, median " +
         apps::digits3(apps::quantile(fewer, 0.5)) + " (meant: 100). Primitives per covered pixel: " + most(per_pixel) +
         " at most, median " + apps::digits3(apps::quantile(per_pixel, 0.5)) +
         " (meant: at most 1.5). Frames: median " + apps::digits3(apps::quantile(ratios, 0.5)) +
         " times as fast (meant: 60); the 99th percentile of frame times is " + apps::digits3(spread) +
         " of their median (meant: under 2).\n\n";
}

}  // namespace

void add_deussen(const Effort& effort, std::span<const PreparedPlant> plants, Times& times) {
  times.add({.table = kField, .plant = "broadleaf", .way = "ours", .reference = "all detail of some, scaled"},
            [&](TimeRow& row) {
              const PreparedPlant plant = plant_of_the_field();
              const std::span one(&plant, 1);
              const double spacing = 1.6 * widest(one), half = spacing * std::sqrt(kFieldPlants) / 2;
              Scene scene(effort, one, make_forest(one, kFieldPlants, spacing, 5));
              const Vec3d eye(-half * 1.2, 0, 2 * static_cast<double>(plant.height_m));
              scene.measure(screen_shot(eye, {1, 0, -0.15}, effort.screen_height()), effort.seconds(), row);
            });
  add_herb(times);
  add_point_sweep(effort, plants.front(), times);
  times.text +=
      "## Deussen 2005: Digital Design of Nature, chapter 10\n\nA field of 1 500 plants whose leaves alone are 8 000 "
      "triangles each, 12 000 000 in all as in the source; 16 : 9, seen from its edge. The reference's are those of "
      "all "
      "plants in view.\n\n" +
      rows_md(times.rows, kField) +
      "Figure 10.14: a small plant whose stems are 106 lines or fewer, from near to far.\n\n" +
      rows_md(times.rows, kHerb) +
      "Figure 10.17: leaves as c_p A / d'^2 points of d', a plant 64 px high, without quads. Where there are no more "
      "points, those there are count.\n\n" +
      rows_md(times.rows, kPoints);
}

void add_forests(const Effort& effort, std::span<const PreparedPlant> plants, Times& times) {
  const auto species = plants.first(std::min<std::size_t>(plants.size(), 7));
  const std::uint32_t trees = effort.quick ? 200 : 4000;
  const double spacing = 1.8 * widest(species), half = spacing * std::sqrt(trees) / 2;
  Lazy<Scene> scene([&] { return Scene(effort, species, make_forest(species, trees, spacing, 3)); });
  const auto path = [&](int frames) { return forest_path(half, frames, effort.screen_height(), species.front()); };
  const std::string name = std::to_string(species.size()) + " species";
  for (const Shot& shot : path(effort.quick ? 3 : 16)) {
    const auto frame =
        std::count_if(times.rows.begin(), times.rows.end(), [](const TimeRow& r) { return r.table == kForest; });
    times.add({.table = kForest,
               .plant = name,
               .way = "ours, frame " + std::to_string(frame),
               .reference = "all detail of some trees, scaled"},
              [&](TimeRow& row) { scene->measure(shot, effort.quick ? 0 : 2, row); });
  }
  const int frames = effort.quick ? 8 : 128;
  times.add({.table = kPath, .plant = name, .way = "ours, " + std::to_string(frames) + " frames"},
            [&](TimeRow& row) { scene->fly(path(frames), effort.quick ? 1 : 3, row); });
  times.text += "## Forests\n\n" + apps::grouped(trees) + " trees of " + name + ", " +
                std::to_string(effort.screen_height()) +
                " rows, over the forest and into it; times by GL with extraction. Bark, leaves and lines are drawn as "
                "two triangles each.\n\n" +
                forest_summary(times.rows) + rows_md(times.rows, kForest) + rows_md(times.rows, kPath);
}

}  // namespace manzana::foliage_benchmark

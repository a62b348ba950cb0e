// Many plants at once: the field of Deussen 2005, and forests. All detail is drawn of a part of them, and scaled.
#include <algorithm>
#include <cmath>

#include "apps/common/markdown.h"
#include "apps/common/quantile.h"
#include "apps/foliage_benchmark/forest.h"
#include "apps/foliage_benchmark/portrait.h"
#include "apps/foliage_benchmark/times_md.h"

namespace manzana::foliage_benchmark {
namespace {

using foliage::Law;
using foliage::PreparedPlant;

constexpr const char* kField = "Deussen 2005, field";
constexpr const char* kPoints = "Deussen 2005, figure 10.17";
constexpr const char* kForest = "forest";
constexpr double kMostFullQuads = 2e5;  // that are drawn at once with all detail

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

/// Of one shot: ours with all plants in view, against all detail of some, times what they stand for.
class Scene {
 public:
  Scene(std::span<const PreparedPlant> plants, std::vector<foliage::TreeSite> sites)
      : extents_(extents_of(plants)), stage_(plants, sites, {.quads = 1U << 22}) {}

  void measure(const Shot& shot, double seconds, TimeRow& row, std::vector<double>* frames_ms = nullptr) {
    const auto all = in_view(stage_, extents_, shot);
    const std::uint64_t primitives = full_primitives(stage_, all);
    const auto every = std::max<std::uint32_t>(
        1, static_cast<std::uint32_t>(std::ceil(static_cast<double>(primitives) / 2 / kMostFullQuads)));
    const auto some = in_view(stage_, extents_, shot, every);
    stage_.set_law(Law::ours);
    row.covered_px = static_cast<double>(covered(stage_.draw(all, shot, kHow)));
    row.primitives = primitives_of(stage_.shown());
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
    row.reference = every > 1 ? "all detail, of " + std::to_string(trees_of(some)) + " trees, scaled" : "all detail";
    if (frames_ms != nullptr) frames_ms->push_back(times.ms);
  }
  Stage& stage() { return stage_; }

 private:
  static constexpr HowDrawn kHow{1, Sampling::product};
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

void add_point_sweep(const Effort& effort, const PreparedPlant& plant, std::vector<TimeRow>& rows) {
  constexpr double kHeightPx = 64;
  if (plant.point_levels.empty()) return;
  Portrait portrait({&plant, 1}, kHeightPx);
  const double pixel_m = static_cast<double>(plant.height_m) / kHeightPx;
  for (const double size_px : {1.0, 1.5, 2.0, 3.0}) {
    for (const double c : {1.0, 1.2, 1.5, 2.0, 3.0}) {
      if (effort.quick && (c != 1.2 || size_px > 1.5)) continue;
      TimeRow row{.table = kPoints, .plant = plant.name, .reference = "all detail"};
      row.way = "c_p " + apps::digits3(c) + ", points of " + apps::digits3(size_px) + " px";
      portrait.look(points_of(plant, c, size_px * pixel_m), all_detail(plant), row);
      rows.push_back(std::move(row));
    }
  }
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

std::string forest_summary(std::span<const TimeRow> rows, std::vector<double> frames_ms) {
  std::vector<double> fewer, per_pixel, ratios;
  for (const TimeRow& row : rows) {
    if (row.table != kForest) continue;
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
         " times as fast (meant: 60); the 99th percentile of frame times is " +
         apps::digits3(apps::quantile(frames_ms, 0.99) / apps::quantile(frames_ms, 0.5)) +
         " of their median (meant: under 2).\n\n";
}

}  // namespace

void add_deussen(const Effort& effort, std::span<const PreparedPlant> plants, Times& times) {
  const PreparedPlant& plant = plants.front();
  const std::span one(&plant, 1);
  const std::uint32_t count = 1500;
  const double spacing = 1.6 * widest(one), half = spacing * std::sqrt(count) / 2;
  Scene scene(one, make_forest(one, count, spacing, 5));
  TimeRow row{.table = kField, .plant = plant.name, .way = "ours"};
  const auto high = static_cast<double>(plant.height_m);
  scene.measure(screen_shot({-half * 1.2, 0, 2 * high}, {1, 0, -0.15}, effort.screen_height()), effort.seconds(), row);
  times.rows.push_back(std::move(row));
  add_point_sweep(effort, plant, times.rows);
  times.text +=
      "## Deussen 2005: Digital Design of Nature, chapter 10\n\nA field of 1 500 plants, 16 : 9, seen from its "
      "edge.\n\n" +
      rows_md(times.rows, kField) +
      "Figure 10.17: leaves as c_p A / d'^2 points of d', a plant 64 px high, without quads. Where there are no more "
      "points, those there are count.\n\n" +
      rows_md(times.rows, kPoints);
}

void add_forests(const Effort& effort, std::span<const PreparedPlant> plants, Times& times) {
  const auto species = plants.first(std::min<std::size_t>(plants.size(), 7));
  const std::uint32_t trees = effort.quick ? 200 : 4000;
  const double spacing = 1.8 * widest(species), half = spacing * std::sqrt(trees) / 2;
  Scene scene(species, make_forest(species, trees, spacing, 3));
  std::vector<double> frames_ms;
  const auto path = forest_path(half, effort.quick ? 2 : 16, effort.screen_height(), species.front());
  for (const Shot& shot : path) {
    TimeRow row{.table = kForest, .plant = std::to_string(species.size()) + " species"};
    row.way = "ours, frame " + std::to_string(&shot - path.data());
    scene.measure(shot, effort.quick ? 0 : 2, row, &frames_ms);
    times.rows.push_back(std::move(row));
  }
  times.text += "## Forests\n\n" + apps::grouped(trees) + " trees of " + std::to_string(species.size()) + " species, " +
                std::to_string(effort.screen_height()) +
                " rows, over the forest and into it; times by GL with extraction.\n\n" +
                forest_summary(times.rows, frames_ms) + rows_md(times.rows, kForest);
}

}  // namespace manzana::foliage_benchmark

// A forest of plants as large as the sources', from over it into it.
#include <algorithm>
#include <cmath>

#include "apps/common/markdown.h"
#include "apps/common/quantile.h"
#include "apps/foliage_benchmark/source_forest.h"
#include "apps/foliage_benchmark/times_md.h"

namespace manzana::foliage_benchmark {
namespace {

using foliage::PreparedPlant;

constexpr const char* kForest = "forest";
constexpr const char* kPath = "forest, path";

/// A way to draw it: our law, and packs and groves. These stay: they come last.
struct Way {
  std::string name;
  Exactness exactness = {};
  bool far = false;
};

std::string summary(std::span<const TimeRow> rows, const Way& way) {
  std::vector<double> fewer, per_pixel, ratios, errors;
  double spread = 0;
  for (const TimeRow& row : rows) {
    if (row.way.rfind(way.name + ": ", 0) != 0) continue;
    if (row.table == kPath && row.ms) spread = *row.ms_99 / *row.ms;
    if (row.table != kForest || !row.primitives) continue;
    const double drawn = std::max(1.0, static_cast<double>(*row.primitives));
    fewer.push_back(static_cast<double>(*row.reference_primitives) / drawn);
    per_pixel.push_back(drawn / std::max(1.0, *row.covered_px));
    ratios.push_back(*row.ratio);
    errors.push_back(*row.error_px);
  }
  if (fewer.empty()) return {};
  const auto least = [](const std::vector<double>& v) { return apps::digits3(*std::min_element(v.begin(), v.end())); };
  const auto most = [](const std::vector<double>& v) { return apps::digits3(*std::max_element(v.begin(), v.end())); };
  const auto middle = [](const std::vector<double>& v) { return apps::digits3(apps::quantile(v, 0.5)); };
  return "**" + way.name + "**, an error of " + least(errors) + " to " + most(errors) +
         " pixels. Fewer primitives than all detail: " + least(fewer) + " times at least, median " + middle(fewer) +
         " (meant: 100). Primitives per covered pixel: " + most(per_pixel) + " at most, median " + middle(per_pixel) +
         " (meant: at most 1.5). Frames: median " + middle(ratios) +
         " times as fast (meant: 60); the 99th percentile of frame times is " + apps::digits3(spread) +
         " of their median (meant: under 2).\n\n";
}

}  // namespace

void add_forests(const Effort& effort, std::span<const PreparedPlant> plants, Times& times) {
  constexpr double kVertices = 600'000;
  const std::uint32_t trees = effort.quick ? 200 : 4000;
  const int stops = effort.quick ? 3 : 16, frames = effort.quick ? 8 : 128;
  Lazy<Forest> forest([&] {
    if (!effort.quick) return Forest(prepare_source_trees(0), trees, 2e6);
    return Forest(
        {plants.begin(), plants.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(plants.size(), 7))}, trees,
        4e4);
  });
  const std::array<Way, 3> ways{
      {{"ours"},
       {"ours with " + apps::grouped(kVertices) + " vertices at most", {.vertices = kVertices}},
       {.name = "ours and small trees as mosaics and groves", .far = true}}};
  const std::string name = effort.quick ? "species at hand" : "seven species of the sources' sizes";
  for (const Way& way : ways) {
    for (int stop = 0; stop < stops; ++stop)
      times.add({.table = kForest,
                 .plant = name,
                 .way = way.name + ": frame " + std::to_string(stop),
                 .reference = "all detail of some trees, scaled"},
                [&](TimeRow& row) {
                  const Shot shot = forest->path(stops, effort.screen_height())[static_cast<std::size_t>(stop)];
                  if (way.far) forest->ground.make_far(forest->plants);
                  forest->ground.measure(shot, way.exactness, effort.quick ? 0 : 2, row);
                });
    times.add({.table = kPath, .plant = name, .way = way.name + ": " + std::to_string(frames) + " frames"},
              [&](TimeRow& row) {
                if (way.far) forest->ground.make_far(forest->plants);
                forest->ground.fly(forest->path(frames, effort.screen_height()), way.exactness, effort.quick ? 1 : 3,
                                   row);
              });
  }
  times.text += "## Forests\n\n" + apps::grouped(trees) + " trees of " + name + ", " +
                std::to_string(effort.screen_height()) +
                " rows, over the forest and into it; the crowns are as large as the ground together. Times by GL with "
                "extraction. Bark, leaves and lines are drawn as two triangles each.\n\n";
  if (!effort.quick) {
    times.text += "Triangles, within 2 %:";
    for (const SourceTree& tree : source_trees())
      times.text += std::string(" ") + tree.species + " " + apps::grouped(tree.triangles) +
                    (&tree == &source_trees().back() ? ".\n\n" : ",");
  }
  for (const Way& way : ways) times.text += summary(times.rows, way);
  times.text += rows_md(times.rows, kForest) + rows_md(times.rows, kPath);
}

}  // namespace manzana::foliage_benchmark

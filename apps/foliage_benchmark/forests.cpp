// A forest of plants as large as the sources', from over it into it.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "apps/common/markdown.h"
#include "apps/common/quantile.h"
#include "apps/foliage_benchmark/ground.h"
#include "apps/foliage_benchmark/stand_in.h"
#include "apps/foliage_benchmark/times_md.h"
#include "foliage/prepare.h"

namespace manzana::foliage_benchmark {
namespace {

using foliage::PreparedPlant;

constexpr const char* kForest = "forest";
constexpr const char* kPath = "forest, path";

/// [Gumbau 2009, table 1; Zhang 2004, table 1] and which of our species stands for it.
struct SourceTree {
  const char* species;
  double triangles;
};
constexpr std::array<SourceTree, 7> kTrees{{{"broadleaf", 32214},
                                            {"lime", 57290},
                                            {"oak", 82310},
                                            {"conifer", 262084},
                                            {"birch", 19076},
                                            {"poplar", 60059},
                                            {"pine", 430836}}};

std::vector<PreparedPlant> source_trees() {
  std::vector<PreparedPlant> plants(kTrees.size());
  tbb::parallel_for(std::size_t{0}, plants.size(), [&](std::size_t i) {
    plants[i] = prepare(grown_dense(kTrees[i].species, kTrees[i].triangles), {.visibility_side = 0});
    plants[i].name = kTrees[i].species;
  });
  return plants;
}

struct Forest {
  std::vector<PreparedPlant> plants;
  double half_m;
  Ground ground;

  Forest(std::vector<PreparedPlant> species, std::uint32_t trees, double most_full_quads)
      : plants(std::move(species)),
        half_m(closed_spacing(plants) * std::sqrt(trees) / 2),
        ground(plants, make_forest(plants, trees, closed_spacing(plants), 3), most_full_quads) {}
  std::vector<Shot> path(int frames, int height_px) const {
    return forest_path(half_m, frames, height_px, static_cast<double>(plants.front().height_m));
  }
};

/// A way to draw it: our law, with so many vertices at most (0: any number), and packs. These stay: they come last.
struct Way {
  std::string name;
  double vertices = 0;
  bool packs = false;
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
    if (!effort.quick) return Forest(source_trees(), trees, 2e6);
    return Forest(
        {plants.begin(), plants.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(plants.size(), 7))}, trees,
        4e4);
  });
  const std::array<Way, 3> ways{{{"ours"},
                                 {"ours with " + apps::grouped(kVertices) + " vertices at most", kVertices},
                                 {.name = "ours and small trees as mosaics", .packs = true}}};
  const std::string name = effort.quick ? "species at hand" : "seven species of the sources' sizes";
  for (const Way& way : ways) {
    for (int stop = 0; stop < stops; ++stop)
      times.add({.table = kForest,
                 .plant = name,
                 .way = way.name + ": frame " + std::to_string(stop),
                 .reference = "all detail of some trees, scaled"},
                [&](TimeRow& row) {
                  const Shot shot = forest->path(stops, effort.screen_height())[static_cast<std::size_t>(stop)];
                  if (way.packs) forest->ground.make_packs(forest->plants);
                  forest->ground.measure(shot, way.vertices, effort.quick ? 0 : 2, row);
                });
    times.add({.table = kPath, .plant = name, .way = way.name + ": " + std::to_string(frames) + " frames"},
              [&](TimeRow& row) {
                if (way.packs) forest->ground.make_packs(forest->plants);
                forest->ground.fly(forest->path(frames, effort.screen_height()), way.vertices, effort.quick ? 1 : 3,
                                   row);
              });
  }
  times.text += "## Forests\n\n" + apps::grouped(trees) + " trees of " + name + ", " +
                std::to_string(effort.screen_height()) +
                " rows, over the forest and into it; the crowns are as large as the ground together. Times by GL with "
                "extraction. Bark, leaves and lines are drawn as two triangles each.\n\n";
  if (!effort.quick) {
    times.text += "Triangles, within 2 %:";
    for (const SourceTree& tree : kTrees)
      times.text += std::string(" ") + tree.species + " " + apps::grouped(tree.triangles) +
                    (&tree == &kTrees.back() ? ".\n\n" : ",");
  }
  for (const Way& way : ways) times.text += summary(times.rows, way);
  times.text += rows_md(times.rows, kForest) + rows_md(times.rows, kPath);
}

}  // namespace manzana::foliage_benchmark

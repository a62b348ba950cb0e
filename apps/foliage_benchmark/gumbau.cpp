// Gumbau 2009: what extraction takes, and what pruned crowns look like.
#include <cmath>

#include "apps/foliage_benchmark/portrait.h"
#include "apps/foliage_benchmark/times_md.h"
#include "foliage/generate.h"
#include "foliage/gl/plant_store.h"
#include "foliage/import/species.h"
#include "foliage/prepare.h"

namespace manzana::foliage_benchmark {
namespace {

/// [Gumbau 2009, tables 1 and 2] milliseconds in all at 66, 33 and 15 %.
struct SourceTree {
  const char* name;
  const char* species;  // of ours, that stands for it
  std::uint32_t triangles;
  std::array<double, 3> ms, kernel_ms;
};
constexpr std::array<SourceTree, 4> kTrees{
    {{"Olea europaea", "broadleaf", 32214, {1.48, 1.41, 1.51}, {0.54, 0.50, 0.47}},
     {"Fraxinus ornus", "lime", 57290, {1.96, 1.71, 1.54}, {0.80, 0.61, 0.62}},
     {"Quercus cerris", "oak", 82310, {1.63, 1.42, 1.12}, {0.83, 0.65, 0.53}},
     {"Cedrus atlantica", "conifer", 262084, {2.86, 2.29, 1.75}, {2.23, 1.53, 1.12}}}};
constexpr std::array kShares{0.66, 0.33, 0.15};
constexpr const char* kTable2 = "Gumbau 2009, table 2";
constexpr const char* kFigure7 = "Gumbau 2009, figure 7";
constexpr const char* kFigure8 = "Gumbau 2009, figure 8";

std::string percent(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

/// A species with as many leaves a stem as come nearest to the source's count of triangles.
foliage::PreparedPlant stand_in(const SourceTree& tree) {
  foliage::SpeciesParams species = foliage::builtin_species(tree.species);
  foliage::Plant plant = grow_plant(species, 1);
  const double triangles = static_cast<double>(plant.mesh.leaves.indices.size()) / 3;
  species.leaves = std::max(1, static_cast<int>(std::lround(species.leaves * tree.triangles / triangles)));
  plant = grow_plant(species, 1);
  foliage::PreparedPlant prepared = prepare(plant);
  prepared.name = std::string(tree.name) + " (" + tree.species + ", " +
                  std::to_string(plant.mesh.leaves.indices.size() / 3) + " leaf triangles)";
  return prepared;
}

void add_extraction(const Effort& effort, const SourceTree& tree, const PreparedPlant& plant, Portrait& portrait,
                    std::vector<TimeRow>& rows) {
  const auto extract_at = [&](double share) {
    portrait.use(pruned(plant, share));
    portrait.stage().extract_only({{portrait.run()}}, portrait.shot(), {});
  };
  for (std::size_t i = 0; i < kShares.size(); ++i) {
    if (effort.quick && i != 1) continue;
    TimeRow row{.table = kTable2, .plant = plant.name, .way = percent(kShares[i]), .reference = "100 %"};
    set_times(time_pairs([&] { extract_at(kShares[i]); }, [&] { extract_at(1); }, effort.seconds(), i), row);
    row.source_value = tree.kernel_ms[i];
    rows.push_back(row);
    row.way += ", buffers made anew";
    const auto anew = [&] {
      const foliage::PlantStore store({&plant, 1});
      extract_at(kShares[i]);
    };
    set_times(time_pairs(
                  anew, [&] { extract_at(kShares[i]); }, effort.seconds(), i),
              row);
    row.reference = "buffers kept";
    row.source_value = tree.ms[i];
    rows.push_back(row);
  }
}

void add_processors(const Effort& effort, const PreparedPlant& plant, Portrait& portrait, std::vector<TimeRow>& rows) {
  constexpr double kShare = 0.30;
  portrait.use(pruned(plant, kShare));
  const auto eye_rows = rows_seen_from(portrait.shot().view.eye);
  const std::array runs{portrait.run()};
  foliage::Selection selection;
  const auto on_cpu = [&] {
    select(portrait.stage().table(), {portrait.stage().sites(), eye_rows, runs, 1 / portrait.shot().focal_px},
           selection);
  };
  TimeRow row{.table = kFigure8, .plant = plant.name, .way = "GL compute, 30 %", .reference = "its twin on one core"};
  set_times(time_pairs([&] { portrait.stage().extract_only(runs, portrait.shot(), {}); }, on_cpu, effort.seconds(), 9),
            row);
  rows.push_back(row);
}

void add_looks(const PreparedPlant& plant, std::vector<TimeRow>& rows) {
  constexpr std::array<std::pair<double, double>, 5> kSteps{
      {{0.70, 256}, {0.50, 181}, {0.35, 128}, {0.20, 91}, {0.15, 64}}};
  for (const auto& [share, height_px] : kSteps) {
    Portrait portrait({&plant, 1}, height_px);
    TimeRow row{.table = kFigure7, .plant = plant.name, .reference = "100 %"};
    row.way = percent(share) + " at " + std::to_string(static_cast<int>(height_px)) + " px";
    portrait.look(pruned(plant, share), all_detail(plant), row);
    rows.push_back(row);
  }
}

}  // namespace

void add_gumbau(const Effort& effort, Times& times) {
  for (const SourceTree& tree : kTrees) {
    if (effort.quick && &tree != &kTrees.front()) break;
    const foliage::PreparedPlant plant = stand_in(tree);
    Portrait portrait({&plant, 1}, 256);
    add_extraction(effort, tree, plant, portrait, times.rows);
    add_processors(effort, plant, portrait, times.rows);
    if (&tree == &kTrees.back() || effort.quick) add_looks(plant, times.rows);
  }
  times.text +=
      "## Gumbau 2009: Modelo multiresolución para la copa de los árboles\n\n"
      "Species of our own with as many leaves as the source's trees stand for them. Table 2: extraction of one tree, "
      "against all of its leaves; `source` is milliseconds on a GeForce 8800 GT, without and with its buffers' "
      "set-up.\n\n" +
      rows_md(times.rows, kTable2) +
      "Figure 7: leaves pruned and scaled to keep the crown's cover, by distance as the source has them.\n\n" +
      rows_md(times.rows, kFigure7) + "Figure 8: the same choice on both processors.\n\n" +
      rows_md(times.rows, kFigure8);
}

}  // namespace manzana::foliage_benchmark

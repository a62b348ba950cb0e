// Gadbem 2011: what each part of a plant costs, branches pruned and as lines, leaves as points.
#include <algorithm>
#include <array>

#include "apps/foliage_benchmark/portrait.h"
#include "apps/foliage_benchmark/times_md.h"
#include "foliage/generate.h"
#include "foliage/import/species.h"
#include "foliage/prepare.h"

namespace manzana::foliage_benchmark {
namespace {

constexpr const char* kTable1 = "Gadbem 2011, table 4.1";
constexpr const char* kTable2 = "Gadbem 2011, table 4.2";
constexpr const char* kTable3 = "Gadbem 2011, table 4.3";
constexpr const char* kFigure26 = "Gadbem 2011, figure 4.26";
constexpr double kHeightPx = 256;

/// [Gadbem 2011, tables 4.1 to 4.3] frames a second of its plants, and the species of ours of the same kind.
struct SourcePlant {
  const char* species;
  const char* name;
  double whole, branches, leaves;
  std::vector<double> levels;  ///< branches from level 1 on; at the last one all are lines
  double points;
};
const std::array<SourcePlant, 5> kSourcePlants{
    {{"shrub", "moleiro-rosa", 320, 882, 1260, {1000, 1090, 1415, 7936}, 1470},
     {"apple", "lilás-comum", 405, 3870, 1300, {5132, 6375, 6990}, 1720},
     {"broadleaf", "árvore-base", 213, 850, 964, {4140, 5140, 6310}, 1115},
     {"oak", "bordo-japonês", 1160, 1380, 3760, {4060, 4400, 5060, 5704}, 1705},
     {"conifer", "pinheiro-do-Canadá", 125, 312, 475, {2170, 5190, 6600}, 875}}};

const SourcePlant* source_of(const PreparedPlant& plant) {
  const auto at = std::find_if(kSourcePlants.begin(), kSourcePlants.end(),
                               [&](const SourcePlant& s) { return plant.name == s.species; });
  return at == kSourcePlants.end() ? nullptr : &*at;
}

using Ratio = std::optional<double>;

class PlantTables {
 public:
  PlantTables(const Effort& effort, const PreparedPlant& plant, Times& times)
      : seconds_(effort.seconds() / 4), plant_(plant), source_(source_of(plant)), times_(times) {
    name_ = plant.name + (source_ == nullptr ? "" : " (" + std::string(source_->name) + ")");
  }

  void add_parts() {
    const Detail whole = all_detail(plant_);
    add(kTable1, "branches alone", without_leaves(whole), "whole", whole,
        ratio(&SourcePlant::branches, &SourcePlant::whole));
    add(kTable1, "leaves alone", without_branches(plant_, whole), "whole", whole,
        ratio(&SourcePlant::leaves, &SourcePlant::whole));
  }
  void add_branches(bool every_level) {
    const Detail all = without_leaves(all_detail(plant_));
    const auto levels = static_cast<std::uint32_t>(plant_.branch_levels.size());
    for (std::uint32_t level = 1; level < levels; level += every_level ? 1 : levels - 1) {
      const std::string name = "level " + std::to_string(level);
      add(kTable2, name + ", pruned alone", without_leaves(at_branch_level(plant_, level, false)), "branches alone",
          all, {});
      add(kTable2, name + ", pruned, lines", without_leaves(at_branch_level(plant_, level, true)), "branches alone",
          all, of_level(level));
    }
    add(kTable2, "lines alone", without_leaves(at_branch_level(plant_, levels, true)), "branches alone", all,
        of_level(0));
  }
  void add_leaves() {
    const Detail cards = without_branches(plant_, all_detail(plant_));
    const Ratio of_source = ratio(&SourcePlant::points, &SourcePlant::leaves);
    for (const double area : {1.0, 0.5})
      add(kTable3, area < 1 ? "points, half the area" : "points",
          without_branches(plant_, leaves_as_points(plant_, area)), "leaf quads alone", cards, of_source);
    add(kTable3, "whole with points", leaves_as_points(plant_, 1), "whole", all_detail(plant_), {});
  }

 private:
  Ratio ratio(double SourcePlant::*way, double SourcePlant::*reference) const {
    return source_ == nullptr ? Ratio{} : source_->*way / source_->*reference;
  }
  /// 0: the last, where all are lines.
  Ratio of_level(std::size_t level) const {
    if (source_ == nullptr || level >= source_->levels.size()) return {};
    return (level == 0 ? source_->levels.back() : source_->levels[level - 1]) / source_->branches;
  }

  void add(const char* table, const std::string& way, const Detail& detail, const char* reference,
           const Detail& reference_detail, const Ratio& of_source) {
    times_.add({.table = table, .plant = name_, .way = way, .reference = reference}, [&](TimeRow& row) {
      portrait_->look(detail, reference_detail, row);
      set_shown(portrait_->stage().shown(), row);
      portrait_->time(detail, reference_detail, seconds_, row);
      row.source_value = of_source;
    });
  }

  double seconds_;
  const PreparedPlant& plant_;
  const SourcePlant* source_;
  std::string name_;
  Lazy<Portrait> portrait_{[this] { return Portrait(plant_, kHeightPx); }};
  Times& times_;
};

/// Each leaf triangle as four, by the middles of its sides.
foliage::Plant with_finer_leaves(foliage::Plant plant) {
  foliage::MeshPart& leaves = plant.mesh.leaves;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    foliage::MeshVertex v = leaves.vertices[a];
    const foliage::MeshVertex& w = leaves.vertices[b];
    v.position = 0.5F * (v.position + w.position);
    v.normal = glm::normalize(v.normal + w.normal);
    v.uv = 0.5F * (v.uv + w.uv);
    v.shade = 0.5F * (v.shade + w.shade);
    leaves.vertices.push_back(v);
    return static_cast<std::uint32_t>(leaves.vertices.size() - 1);
  };
  std::vector<std::uint32_t> finer;
  for (std::size_t i = 0; i < leaves.indices.size(); i += 3) {
    const std::uint32_t a = leaves.indices[i], b = leaves.indices[i + 1], c = leaves.indices[i + 2];
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    finer.insert(finer.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
  }
  leaves.indices = std::move(finer);
  for (foliage::Terminal& terminal : plant.terminals) {
    terminal.triangles.first *= 4;
    terminal.triangles.last *= 4;
  }
  return plant;
}

/// Leaves as points, where a leaf is a card of 2 triangles and where the same card has 8.
void add_cards(Times& times) {
  const char* species = "shrub";
  const auto make = [&](bool finer) {
    foliage::Plant plant = grow_plant(foliage::builtin_species(species), 1);
    return prepare(finer ? with_finer_leaves(std::move(plant)) : plant, {.visibility_side = 0});
  };
  Lazy<PreparedPlant> two([&] { return make(false); }), eight([&] { return make(true); });
  Lazy<Portrait> of_two([&] { return Portrait(*two, kHeightPx); }),
      of_eight([&] { return Portrait(*eight, kHeightPx); });
  const auto add = [&](const char* way, Lazy<PreparedPlant>& plant, Lazy<Portrait>& portrait) {
    times.add({.table = kFigure26, .plant = species, .way = way, .reference = "its leaf quads"}, [&](TimeRow& row) {
      portrait->look(without_branches(*plant, leaves_as_points(*plant, 1)),
                     without_branches(*plant, all_detail(*plant)), row);
    });
  };
  add("points of cards of 2 triangles", two, of_two);
  add("points of cards of 8 triangles", eight, of_eight);
}

/// Those of the source's kinds; where there are none the first five.
std::vector<const PreparedPlant*> chosen(std::span<const PreparedPlant> plants, std::size_t most) {
  std::vector<const PreparedPlant*> all;
  for (const PreparedPlant& plant : plants)
    if (source_of(plant) != nullptr) all.push_back(&plant);
  for (const PreparedPlant& plant : plants)
    if (source_of(plant) == nullptr) all.push_back(&plant);
  all.resize(std::min(all.size(), most));
  return all;
}

}  // namespace

void add_gadbem(const Effort& effort, std::span<const foliage::PreparedPlant> plants, Times& times) {
  for (const PreparedPlant* plant : chosen(plants, effort.quick ? 1 : kSourcePlants.size())) {
    PlantTables tables(effort, *plant, times);
    tables.add_parts();
    tables.add_branches(!effort.quick);
    tables.add_leaves();
  }
  add_cards(times);
  times.text +=
      "## Gadbem 2011: Simplificação de plantas\n\nOne plant, 256 px high. Errors are against the row's reference, "
      "finely sampled. `source`: how many times as fast the source's plant of that kind is; its levels are fewer than "
      "ours.\n\nTable 4.1: parts. Their times do not add up to the whole's.\n\n" +
      rows_md(times.rows, kTable1) +
      "Table 4.2: branches, without leaves: pruned alone, completed by lines, lines alone.\n\n" +
      rows_md(times.rows, kTable2) + "Table 4.3: leaves as points of the finest level.\n\n" +
      rows_md(times.rows, kTable3) +
      "Figure 4.26: leaves as points, of cards of 2 triangles and of the same cards cut into 8; without branches.\n\n" +
      rows_md(times.rows, kFigure26);
}

}  // namespace manzana::foliage_benchmark

// Gadbem 2011: what each part of a plant costs, branches pruned and as lines, leaves as points.
#include "apps/foliage_benchmark/portrait.h"
#include "apps/foliage_benchmark/times_md.h"

namespace manzana::foliage_benchmark {
namespace {

constexpr const char* kTable1 = "Gadbem 2011, table 4.1";
constexpr const char* kTable2 = "Gadbem 2011, table 4.2";
constexpr const char* kTable3 = "Gadbem 2011, table 4.3";
constexpr double kHeightPx = 256;

class PlantTables {
 public:
  PlantTables(const Effort& effort, const PreparedPlant& plant, std::vector<TimeRow>& rows)
      : seconds_(effort.seconds() / 4), plant_(plant), portrait_({&plant, 1}, kHeightPx), rows_(rows) {}

  void add_parts() {
    const Detail whole = all_detail(plant_);
    add(kTable1, "branches alone", without_leaves(whole), "whole", whole);
    add(kTable1, "leaves alone", without_branches(plant_, whole), "whole", whole);
  }
  void add_branches(bool every_level) {
    const Detail all = without_leaves(all_detail(plant_));
    const auto levels = static_cast<std::uint32_t>(plant_.branch_levels.size());
    for (std::uint32_t level = 1; level < levels; level += every_level ? 1 : levels - 1) {
      const std::string name = "level " + std::to_string(level);
      add(kTable2, name + ", pruned alone", without_leaves(at_branch_level(plant_, level, false)), "branches alone",
          all);
      add(kTable2, name + ", pruned, lines", without_leaves(at_branch_level(plant_, level, true)), "branches alone",
          all);
    }
    add(kTable2, "lines alone", without_leaves(at_branch_level(plant_, levels, true)), "branches alone", all);
  }
  void add_leaves() {
    const Detail cards = without_branches(plant_, all_detail(plant_));
    for (const double area : {1.0, 0.5})
      add(kTable3, area < 1 ? "points, half the area" : "points",
          without_branches(plant_, leaves_as_points(plant_, area)), "leaf quads alone", cards);
    add(kTable3, "whole with points", leaves_as_points(plant_, 1), "whole", all_detail(plant_));
  }

 private:
  void add(const char* table, const std::string& way, const Detail& detail, const char* reference,
           const Detail& reference_detail) {
    TimeRow row{.table = table, .plant = plant_.name, .way = way, .reference = reference};
    portrait_.look(detail, reference_detail, row);
    portrait_.time(detail, reference_detail, seconds_, row);
    rows_.push_back(std::move(row));
  }

  double seconds_;
  const PreparedPlant& plant_;
  Portrait portrait_;
  std::vector<TimeRow>& rows_;
};

}  // namespace

void add_gadbem(const Effort& effort, std::span<const foliage::PreparedPlant> plants, Times& times) {
  for (const PreparedPlant& plant : plants.first(std::min<std::size_t>(plants.size(), effort.quick ? 1 : 5))) {
    PlantTables tables(effort, plant, times.rows);
    tables.add_parts();
    tables.add_branches(!effort.quick);
    tables.add_leaves();
  }
  times.text +=
      "## Gadbem 2011: Simplificação de plantas\n\nOne plant, 256 px high. Errors are against the row's reference, "
      "finely sampled.\n\nTable 4.1: parts. Their times do not add up to the whole's.\n\n" +
      rows_md(times.rows, kTable1) +
      "Table 4.2: branches, without leaves: pruned alone, completed by lines, lines alone.\n\n" +
      rows_md(times.rows, kTable2) + "Table 4.3: leaves as points of the finest level.\n\n" +
      rows_md(times.rows, kTable3);
}

}  // namespace manzana::foliage_benchmark

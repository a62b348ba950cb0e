#include "apps/culling_benchmark/extremes_tables.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/common/csv.h"
#include "apps/common/markdown.h"
#include "files/whole_file.h"

namespace manzana::culling_benchmark {
namespace {

using Row = ExtremesRow;
constexpr std::array kRowColumns{
    apps::Column<Row>{"place", "", "of the eye", &Row::place},
    apps::Column<Row>{"near_m", "m", "near plane", &Row::near_m},
    apps::Column<Row>{"far_m", "m", "far plane; inf: none", &Row::far_m},
    apps::Column<Row>{"fovy_deg", "degrees", "field of view, along the height", &Row::fovy_deg},
    apps::Column<Row>{"way", "", "of culling", &Row::way},
    apps::Column<Row>{"precision", "", "that it computes in", &Row::precision},
    apps::Column<Row>{"objects", "", "any: evenly spread; touching: 1e-9 to 1e-1 m in view", &Row::objects},
    apps::Column<Row>{"asked", "", "objects asked about", &Row::asked},
    apps::Column<Row>{"seen", "", "of these exactly in view", &Row::seen},
    apps::Column<Row>{"missed", "", "in view but not in the answer", &Row::missed},
    apps::Column<Row>{"falsely_kept", "", "in the answer but not in view", &Row::falsely_kept},
    apps::Column<Row>{"deepest_missed_m", "m", "how far a missed object would have to move to leave the view",
                      &Row::deepest_missed_m},
};
constexpr std::array kFarColumns{
    apps::Column<FarRow>{"place", "", "of the eye", &FarRow::place},
    apps::Column<FarRow>{"near_m", "m", "near plane", &FarRow::near_m},
    apps::Column<FarRow>{"far_m", "m", "far plane as the camera has it", &FarRow::far_m},
    apps::Column<FarRow>{"way", "", "of culling", &FarRow::way},
    apps::Column<FarRow>{"precision", "", "of its matrices or planes", &FarRow::precision},
    apps::Column<FarRow>{"cameras", "", "asked", &FarRow::cameras},
    apps::Column<FarRow>{"without", "", "cameras whose far plane has no normal, or is left out", &FarRow::without},
    apps::Column<FarRow>{"inward_m", "m", "the far plane lies that much too near, at most", &FarRow::inward_m},
    apps::Column<FarRow>{"outward_m", "m", "the far plane lies that much too far, at most", &FarRow::outward_m},
};

std::size_t place_of(std::vector<std::string>& all, const std::string& name) {
  const auto found = std::find(all.begin(), all.end(), name);
  if (found != all.end()) return static_cast<std::size_t>(found - all.begin());
  all.push_back(name);
  return all.size() - 1;
}

}  // namespace

void ExtremesSum::add(const ExtremesRow& row) {
  asked += static_cast<double>(row.asked);
  seen += static_cast<double>(row.seen);
  missed += static_cast<double>(row.missed);
  falsely_kept += static_cast<double>(row.falsely_kept);
  deepest_missed_m = std::max(deepest_missed_m, row.deepest_missed_m);
}

ExtremesSum sum(const Extremes& extremes, const ExtremesFilter& which) {
  ExtremesSum all;
  for (const ExtremesRow& row : extremes.rows)
    if (which(row)) all.add(row);
  return all;
}

std::vector<std::vector<std::string>> pivot(const Extremes& extremes, const ExtremesFilter& which,
                                            const ExtremesKey& key,
                                            const std::function<std::string(const ExtremesSum&)>& cell) {
  std::vector<std::string> ways, keys;
  std::vector<std::vector<ExtremesSum>> sums;
  for (const ExtremesRow& row : extremes.rows) {
    if (!which(row)) continue;
    const std::size_t way = place_of(ways, row.way), column = place_of(keys, key(row));
    sums.resize(std::max(sums.size(), way + 1));
    sums[way].resize(std::max(sums[way].size(), column + 1));
    sums[way][column].add(row);
  }
  std::vector<std::vector<std::string>> cells{{""}};
  cells[0].insert(cells[0].end(), keys.begin(), keys.end());
  for (std::size_t way = 0; way < ways.size(); ++way) {
    cells.push_back({ways[way]});
    for (const ExtremesSum& s : sums[way]) cells.back().push_back(cell(s));
  }
  return cells;
}

std::string depths_text(double near_m, double far_m) {
  return apps::to_cell(near_m) + " / " + (std::isfinite(far_m) ? apps::grouped(far_m) : "infinite");
}

std::string by_field(const ExtremesRow& row) { return apps::to_cell(row.fovy_deg); }

void write_extremes(const std::filesystem::path& folder, const Extremes& extremes) {
  files::write_whole(folder / "extremes.csv", apps::to_csv<ExtremesRow>(extremes.rows, kRowColumns));
  files::write_whole(folder / "extremes_far.csv", apps::to_csv<FarRow>(extremes.far, kFarColumns));
  files::write_whole(folder / "extremes.svg", extremes_svg(extremes));
}

std::string extremes_columns_md() {
  return "\n## extremes.csv\n" + explain<ExtremesRow>(kRowColumns) + "\n## extremes_far.csv\n" +
         explain<FarRow>(kFarColumns);
}

}  // namespace manzana::culling_benchmark

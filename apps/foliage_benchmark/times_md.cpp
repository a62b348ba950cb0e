#include "apps/foliage_benchmark/times_md.h"

#include <algorithm>

#include "apps/common/markdown.h"

namespace manzana::foliage_benchmark {
namespace {

using apps::digits3;
using apps::grouped;

std::string count_of(const std::optional<std::uint64_t>& n) { return n ? grouped(static_cast<double>(*n)) : ""; }
std::string value_of(const std::optional<double>& v) { return v ? digits3(*v) : ""; }
std::string ratio_of(const TimeRow& row) {
  if (!row.ratio) return "";
  return digits3(*row.ratio) + " [" + digits3(*row.ratio_lo) + ", " + digits3(*row.ratio_hi) + "]";
}

std::vector<std::string> cells_of(const TimeRow& row) {
  return {row.plant,
          row.way,
          row.reference,
          grouped(static_cast<double>(row.trees)),
          value_of(row.error_px),
          count_of(row.primitives),
          count_of(row.reference_primitives),
          count_of(row.bark),
          count_of(row.leaves),
          count_of(row.lines),
          count_of(row.points),
          value_of(row.covered_px),
          value_of(row.overdraw),
          value_of(row.ms),
          value_of(row.ms_99),
          value_of(row.reference_ms),
          ratio_of(row),
          row.bytes ? grouped(*row.bytes) : "",
          value_of(row.cover),
          value_of(row.colour),
          value_of(row.ssim),
          value_of(row.gmsd),
          value_of(row.source_value)};
}

using Cells = std::vector<std::vector<std::string>>;

void leave_out_empty(Cells& cells) {
  for (std::size_t column = cells.front().size(); column-- > 0;) {
    const bool empty =
        std::all_of(cells.begin() + 1, cells.end(), [&](const auto& row) { return row[column].empty(); });
    if (!empty) continue;
    for (auto& row : cells) row.erase(row.begin() + static_cast<std::ptrdiff_t>(column));
  }
}

}  // namespace

std::string rows_md(std::span<const TimeRow> rows, std::string_view table) {
  Cells cells{{"plant",        "way",           "reference", "trees",  "error px",
               "primitives",   "reference's",   "bark",      "leaves", "lines",
               "points",       "covered px",    "overdraw",  "ms",     "ms, 99th percentile",
               "reference ms", "times as fast", "bytes",     "cover",  "colour",
               "SSIM",         "GMSD",          "source"}};
  for (const TimeRow& row : rows)
    if (row.table == table) cells.push_back(cells_of(row));
  if (cells.size() == 1) return {};
  leave_out_empty(cells);
  return apps::md_table(cells);
}

}  // namespace manzana::foliage_benchmark

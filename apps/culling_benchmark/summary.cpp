#include "apps/culling_benchmark/summary.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

#include "apps/common/statistics.h"
#include "apps/culling_benchmark/catalogue.h"
#include "apps/culling_benchmark/rules.h"

namespace manzana::culling_benchmark {
namespace {

using C = apps::Column<SummaryRow>;
using S = SummaryRow;

const std::array kColumns{
    C{"case", "", "city, far plane, caches; see --list", &S::case_name},
    C{"peer", "", "the structure; see --list", &S::peer},
    C{"median_us", "us",
      "of a query: median over the timed frames, the rounds, the processes; of bqr also over all it was timed beside",
      &S::median_us},
    C{"ratio_to_bqr", "", "this structure's time over bqr's, measured side by side; of bqr: over a second bqr",
      &S::ratio},
    C{"accepted", "objects", "in the answers, summed over the frames of the flight", &S::accepted},
    C{"exact", "objects", "whose box meets the view, by separating axes; summed likewise", &S::exact},
    C{"missed", "objects", "of these, not in the answers; must be 0", &S::missed},
    C{"triangles", "", "of accepted objects, summed likewise", &S::triangles},
    C{"build_ms", "ms", "to build the structure: median over the processes", &S::build_ms},
    C{"bytes", "", "of the structure with all bounds that it reads", &S::bytes},
    C{"grain", "", "what it decides about: object, or block with all that is in it", &S::grain},
    C{"ratio_lo", "",
      "of ratio_to_bqr: the least of the processes; of one process: the lower end of a 95 % interval by rank",
      &S::ratio_lo},
    C{"ratio_hi", "", "likewise the most, or the upper end", &S::ratio_hi},
    C{"pairs", "", "rounds beside a round of bqr, in the process that had the fewest", &S::pairs},
    C{"processes", "", "that the row stands on", &S::processes},
    C{"frames", "", "of the flight that counts are summed over", &S::frames},
    C{"timed_frames", "", "of these, timed in each round; in the process that had the fewest", &S::timed_frames},
    C{"dirty", "",
      "processes in which the machine was disturbed in every attempt; they count only if no other is there", &S::dirty},
    C{"objects", "", "in the city", &S::objects},
    C{"blocks", "", "in the city", &S::blocks},
};

using Rows = std::vector<const RunRow*>;

std::vector<double> values(const Rows& rows, double RunRow::*field) {
  std::vector<double> all;
  for (const RunRow* row : rows) all.push_back(row->*field);
  return all;
}

std::uint64_t fewest(const Rows& rows, std::uint64_t RunRow::*field) {
  std::uint64_t least = rows.front()->*field;
  for (const RunRow* row : rows) least = std::min(least, row->*field);
  return least;
}

/// Dirty by its own mark, or because a later calibration showed that the machine can do better.
bool is_dirty(const RunRow& row, double best_calibration_ms) {
  return row.dirty != 0 || row.calibration_ms > 1.1 * best_calibration_ms;
}

void set_ratio(SummaryRow& s, const Rows& rows) {
  const auto ratios = values(rows, &RunRow::ratio);
  const bool one = rows.size() == 1;
  s.ratio = apps::median_ratio(ratios);
  s.ratio_lo = one ? rows.front()->ratio_lo : *std::min_element(ratios.begin(), ratios.end());
  s.ratio_hi = one ? rows.front()->ratio_hi : *std::max_element(ratios.begin(), ratios.end());
}

void set_values(SummaryRow& s, const Rows& rows) {
  const RunRow& any = *rows.front();  // counts are the same in all, or faults() says so
  s.median_us = apps::median(values(rows, &RunRow::median_us));
  s.build_ms = apps::median(values(rows, &RunRow::build_ms));
  s.accepted = any.accepted;
  s.exact = any.exact;
  s.missed = any.missed;
  s.triangles = any.triangles;
  s.bytes = any.bytes;
  s.frames = any.frames;
  s.objects = any.objects;
  s.blocks = any.blocks;
  s.pairs = fewest(rows, &RunRow::pairs);
  s.timed_frames = fewest(rows, &RunRow::timed_frames);
  s.processes = rows.size();
  set_ratio(s, rows);
}

/// What it took beside each structure: many more rounds than of any other, spread over all of the case's time.
double time_of_bqr(const std::string& case_name, std::span<const RunRow> rows, double best_calibration_ms) {
  std::vector<double> all, clean;
  for (const RunRow& row : rows) {
    if (row.case_name != case_name) continue;
    all.push_back(row.bqr_us);
    if (!is_dirty(row, best_calibration_ms)) clean.push_back(row.bqr_us);
  }
  return apps::median(clean.empty() ? all : clean);
}

SummaryRow summarise_one(const std::string& case_name, const std::string& peer, std::span<const RunRow> rows,
                         double best_calibration_ms) {
  SummaryRow s;
  s.case_name = case_name;
  s.peer = peer;
  s.grain = peer_info(peer)->grain == baselines::Grain::block ? "block" : "object";
  Rows all, clean;
  for (const RunRow& row : rows) {
    if (row.case_name != case_name || row.peer != peer) continue;
    all.push_back(&row);
    if (!is_dirty(row, best_calibration_ms)) clean.push_back(&row);
  }
  if (all.empty()) return s;
  s.dirty = all.size() - clean.size();
  set_values(s, clean.empty() ? all : clean);
  if (peer == "bqr") s.median_us = time_of_bqr(case_name, rows, best_calibration_ms);
  return s;
}

auto counts_of(const RunRow& r) { return std::tie(r.accepted, r.exact, r.missed, r.triangles); }

}  // namespace

std::vector<SummaryRow> summarise(const Options& options, std::span<const RunRow> rows) {
  double best = 1e9;
  for (const RunRow& row : rows) best = std::min(best, row.calibration_ms);
  std::vector<SummaryRow> table;
  for (const std::string& name : cases_of(options))
    for (const std::string& peer : peers_for(options, name)) table.push_back(summarise_one(name, peer, rows, best));
  return table;
}

const SummaryRow* find_row(std::span<const SummaryRow> table, std::string_view case_name, std::string_view peer) {
  const auto row = std::find_if(table.begin(), table.end(),
                                [&](const SummaryRow& s) { return s.case_name == case_name && s.peer == peer; });
  return row != table.end() && row->measured() ? &*row : nullptr;
}

std::span<const apps::Column<SummaryRow>> summary_columns() { return kColumns; }

std::string to_csv(std::span<const SummaryRow> rows) { return apps::to_csv<SummaryRow>(rows, kColumns); }

std::vector<std::string> faults(std::span<const RunRow> rows) {
  std::vector<std::string> lines;
  std::map<std::pair<std::string, std::string>, const RunRow*> first;
  for (const RunRow& row : rows) {
    const RunRow& before = *first.try_emplace({row.case_name, row.peer}, &row).first->second;
    const std::string who = row.peer + " on " + row.case_name;
    if (&before == &row && row.missed > 0)
      lines.push_back(who + " MISSED " + std::to_string(row.missed) + " of " + std::to_string(row.exact) + " objects");
    if (counts_of(row) != counts_of(before))
      lines.push_back(who + " answered otherwise in process " + std::to_string(row.process));
  }
  return lines;
}

}  // namespace manzana::culling_benchmark

#include "apps/culling_benchmark/report_goals.h"

#include "apps/culling_benchmark/goals.h"
#include "apps/culling_benchmark/markdown.h"

namespace manzana::culling_benchmark {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string met(double low, double value, double high, double most) {
  if (high <= most) return "met";
  if (low > most) return "**not met**";
  return value <= most ? "met, but not by all of the interval" : "**not met**, but not by all of the interval";
}

void add_ratios(Rows& rows, std::span<const SummaryRow> table) {
  for (const Goal& goal : goals()) {
    const SummaryRow* row = find_row(table, goal.case_name, goal.peer);
    if (row == nullptr) continue;
    const double low = 1 / *row->ratio_hi, value = 1 / *row->ratio, high = 1 / *row->ratio_lo;
    rows.push_back({"time over " + std::string(goal.peer) + "'s, " + std::string(goal.case_name),
                    "<= " + digits3(goal.most), digits3(value) + " [" + digits3(low) + ", " + digits3(high) + "]",
                    met(low, value, high, goal.most)});
  }
}

void add_growth(Rows& rows, std::span<const SummaryRow> table) {
  const SummaryRow *small = find_row(table, "100k-1km", "bqr"), *large = find_row(table, "1M-1km", "bqr");
  if (small == nullptr || large == nullptr) return;
  const double growth = *large->median_us / *small->median_us;
  rows.push_back({"time of 1M-1km over 100k-1km", "<= " + digits3(kMostGrowth), digits3(growth),
                  met(growth, growth, growth, kMostGrowth)});
}

void add_answers(Rows& rows, std::span<const SummaryRow> table) {
  double worst = 0;
  std::uint64_t missed = 0;
  for (const SummaryRow& s : table) {
    if (s.peer != "bqr" || !s.measured()) continue;
    if (*s.exact > 0) worst = std::max(worst, static_cast<double>(*s.accepted) / static_cast<double>(*s.exact));
    missed += *s.missed;
  }
  rows.push_back({"accepted / exact, the worst case", "<= " + to_cell(kMostAccepted), to_cell(worst),
                  worst <= kMostAccepted ? "met" : "**not met**"});
  rows.push_back({"missed", "0", std::to_string(missed), missed == 0 ? "met" : "**not met**"});
}

}  // namespace

std::string goals_text(std::span<const SummaryRow> table) {
  Rows rows{{"bqr's", "goal", "reached", ""}};
  add_ratios(rows, table);
  add_growth(rows, table);
  if (rows.size() == 1) return {};
  add_answers(rows, table);
  return "## What bqr is meant to reach\n" + md_table(rows);
}

std::string rivals_text(std::span<const SummaryRow> table) {
  Rows rows{{"time over linear-simd's", "known", "here", "at most 1.3 times as slow"}};
  for (const Known& known : known_rivals()) {
    const SummaryRow* row = find_row(table, known.case_name, known.peer);
    const SummaryRow* linear = find_row(table, known.case_name, "linear-simd");
    if (row == nullptr || linear == nullptr || row->grain != known.grain) continue;
    const double here = *row->median_us / *linear->median_us, there = known.us / known.linear_simd_us;
    rows.push_back({std::string(known.peer) + ", " + std::string(known.case_name), digits3(there), digits3(here),
                    here <= kSlowest * there ? "yes" : "**no**"});
  }
  if (rows.size() == 1) return {};
  return "## Whether the rivals are at their best\nA figure counts only against a rival that is as quick as it can be: "
         "its time over that of linear-simd, here and where it was measured by itself.\n\n" +
         md_table(rows);
}

}  // namespace manzana::culling_benchmark

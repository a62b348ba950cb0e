#include "apps/culling_benchmark/report_goals.h"

#include <algorithm>
#include <array>

#include "apps/common/markdown.h"
#include "apps/culling_benchmark/catalogue.h"
#include "apps/culling_benchmark/goals.h"

namespace manzana::culling_benchmark {
namespace {

using Rows = std::vector<std::vector<std::string>>;
using Table = std::span<const SummaryRow>;

/// Time over linear-simd's: as it was known, and here, both beside bqr, so that a slow hour of the machine cancels.
struct OverLinear {
  double known = 0, here = 0;
};
std::optional<OverLinear> over_linear(Table table, const Known& known) {
  const SummaryRow* row = find_row(table, known.case_name, known.peer);
  const SummaryRow* linear = find_row(table, known.case_name, "linear-simd");
  if (row == nullptr || linear == nullptr || row->grain != known.grain) return std::nullopt;
  return OverLinear{known.us / known.linear_simd_us, *row->ratio / *linear->ratio};
}

std::optional<OverLinear> over_linear(Table table, const Goal& goal) {
  for (const Known& known : known_rivals())
    if (known.case_name == goal.case_name && known.peer == goal.peer) return over_linear(table, known);
  return std::nullopt;
}

std::string met(double low, double value, double high, double most) {
  if (high <= most) return "met";
  if (low > most) return "**not met**";
  return value <= most ? "met, but not by all of the interval" : "**not met**, but not by all of the interval";
}

/// bqr's time over the row's: what is reached, and whether that is enough.
std::vector<std::string> reached(const std::string& what, const SummaryRow& row, double most) {
  const double low = 1 / *row.ratio_hi, value = 1 / *row.ratio, high = 1 / *row.ratio_lo;
  return {what, "<= " + apps::digits3(most),
          apps::digits3(value) + " [" + apps::digits3(low) + ", " + apps::digits3(high) + "]",
          met(low, value, high, most)};
}

void add_ratios(Rows& rows, Table table) {
  for (const Goal& goal : goals()) {
    const SummaryRow* row = find_row(table, goal.case_name, goal.peer);
    const SummaryRow* linear = find_row(table, goal.case_name, "linear-simd");
    if (row == nullptr) continue;
    rows.push_back(reached(std::string(goal.case_name) + ": bqr over " + std::string(goal.peer), *row, goal.most));
    const auto rival = over_linear(table, goal);
    for (const double value :
         rival ? std::array{rival->known, rival->here, 1 / (*linear->ratio * rival->known)} : std::array{0.0, 0.0, 0.0})
      rows.back().push_back(rival ? apps::digits3(value) : "");
  }
}

void add_growth(Rows& rows, Table table) {
  if (const SummaryRow* small = find_row(table, "1M-1km", kSmallerCity))
    rows.push_back(reached("1M-1km: bqr over bqr in 100k-1km", *small, kMostGrowth));
}

void add_answers(Rows& rows, Table table) {
  double worst = 0;
  std::uint64_t missed = 0;
  for (const SummaryRow& s : table) {
    if (s.peer != "bqr" || !s.measured()) continue;
    if (*s.exact > 0) worst = std::max(worst, static_cast<double>(*s.accepted) / static_cast<double>(*s.exact));
    missed += *s.missed;
  }
  rows.push_back({"all cases: bqr accepted / exact, the worst", "<= " + apps::to_cell(kMostAccepted),
                  apps::to_cell(worst), worst <= kMostAccepted ? "met" : "**not met**"});
  rows.push_back(
      {"all cases: objects that bqr missed", "0", std::to_string(missed), missed == 0 ? "met" : "**not met**"});
}

/// "vam16 takes 0.21 to 0.50 of it"
std::string quicker_text(Table table) {
  std::string text;
  for (const std::string_view peer : {"vam16", "bvh8", "boost-frustum", "osg"}) {
    double least = 1e9, most = 0;
    for (const Goal& goal : goals()) {
      const auto rival = goal.peer == peer ? over_linear(table, goal) : std::nullopt;
      if (!rival) continue;
      least = std::min(least, rival->here / rival->known);
      most = std::max(most, rival->here / rival->known);
    }
    if (most > 0)
      text +=
          (text.empty() ? "" : ", ") + std::string(peer) + " " + apps::digits3(least) + " to " + apps::digits3(most);
  }
  return text.empty() ? "" : "Here over known, of all cases: " + text + " times.\n";
}

std::string linear_text(Table table) {
  std::string text;
  for (const Known& known : known_rivals()) {
    const SummaryRow* linear = find_row(table, known.case_name, "linear-simd");
    if (known.peer != "linear" || linear == nullptr) continue;
    text += (text.empty() ? "" : ", ") + std::string(known.case_name) + " " + apps::digits3(*linear->median_us) +
            " us (" + apps::digits3(known.linear_simd_us) + ")";
  }
  return text.empty() ? "" : "linear-simd itself takes here (took there): " + text + ".\n";
}

/// How many goals that have a known rival would be met against it.
std::string as_known_text(Table table) {
  std::size_t all = 0, met = 0;
  for (const Goal& goal : goals()) {
    const auto rival = over_linear(table, goal);
    if (!rival) continue;
    ++all;
    met += 1 / (*find_row(table, goal.case_name, "linear-simd")->ratio * rival->known) <= goal.most ? 1 : 0;
  }
  return all == 0 ? ""
                  : "Against the rivals as they were known " + std::to_string(met) + " of these " +
                        std::to_string(all) + " goals would be met. ";
}

std::string count_text(const Rows& rows) {
  const auto count = std::count_if(rows.begin() + 1, rows.end(), [](const auto& row) { return row[3] == "met"; });
  return std::to_string(count) + " of " + std::to_string(rows.size() - 1) + " goals are met. ";
}

}  // namespace

std::string goals_text(Table table) {
  Rows rows{{"case: whose time over whose", "goal", "reached [interval]", "met?", "rival over linear-simd, known",
             "the same, here", "bqr over the rival as known"}};
  add_ratios(rows, table);
  add_growth(rows, table);
  if (rows.size() == 1) return {};
  add_answers(rows, table);
  for (auto& row : rows) row.resize(rows.front().size());
  return "## What bqr is meant to reach\n" + count_text(rows) +
         "A goal is *met* when all of the interval is within it. The goals were set on what the rivals were known to "
         "take, in another program; a rival that is quicker here makes its goal harder by as much. So each row has "
         "the rival's time over linear-simd's, *known* and *here*, and last what bqr would reach against the rival as "
         "it was known: bqr over linear-simd, here, divided by *known*.\n\n" +
         apps::md_table(rows) + as_known_text(table) + quicker_text(table) + linear_text(table) + "\n";
}

std::string rivals_text(Table table) {
  Rows rows{{"time over linear-simd's", "known", "here", "at most 1.3 times as slow"}};
  for (const Known& known : known_rivals())
    if (const auto rival = over_linear(table, known))
      rows.push_back({std::string(known.case_name) + ": " + std::string(known.peer), apps::digits3(rival->known),
                      apps::digits3(rival->here), rival->here <= kSlowest * rival->known ? "yes" : "**no**"});
  if (rows.size() == 1) return {};
  return "## Whether the rivals are at their best\nA figure counts only against a rival that is as quick as it can be: "
         "its time over that of linear-simd, here and where it was measured by itself. Rivals are compiled for the "
         "machine at hand (-march=native), bqr is not: it chooses its instructions when it runs.\n\n" +
         apps::md_table(rows);
}

}  // namespace manzana::culling_benchmark

#include "apps/culling_benchmark/report.h"

#include <algorithm>

#include "apps/common/machine.h"
#include "apps/common/markdown.h"
#include "apps/culling_benchmark/catalogue.h"
#include "apps/culling_benchmark/plots.h"
#include "apps/culling_benchmark/report_goals.h"
#include "apps/culling_benchmark/report_growth.h"
#include "apps/culling_benchmark/report_trade.h"
#include "apps/culling_benchmark/rules.h"
#include "apps/culling_benchmark/trade.h"

namespace manzana::culling_benchmark {
namespace {

using Rows = std::vector<std::vector<std::string>>;

constexpr const char* kAbout =
    "What finding the objects in view takes with **bqr**, the BqR-Tree of this library, and with other structures, and "
    "whether their answers are right. Goals first; then how it was timed and the structures, whether the rivals are as "
    "quick as they can be, how the cost grows, speed for accuracy, each case by itself, moving cars, the extremes, and "
    "the experiments of Pina 2009, as far as they were asked for. All figures are in summary.csv, runs.csv and the "
    "other tables beside this file; columns.md explains them.\n\n";

std::string head_text(const Options& options) {
  const apps::Machine& m = apps::this_machine();
  const Rows rows{{"", "what"},
                  {"processor", m.processor},
                  {"caches", m.caches},
                  {"memory", m.memory},
                  {"system", m.system},
                  {"compiler", m.compiler},
                  {"vector instructions of bqr", m.simd},
                  {"commit", m.commit},
                  {"finished", apps::now_utc()},
                  {"seed", std::to_string(options.seed)}};
  std::string text = "# Culling benchmark\n" + std::string(kAbout) + "| " + rows[0][0] + " | |\n|---|---|\n";
  for (std::size_t i = 1; i < rows.size(); ++i) text += "| " + rows[i][0] + " | " + rows[i][1] + " |\n";
  return text + "\n";
}

std::string verdict_text(std::span<const SummaryRow> table, std::span<const std::string> wrong) {
  if (!wrong.empty()) {
    std::string text = "**Answers were wrong:**\n";
    for (const std::string& line : wrong) text += "- **" + line + "**\n";
    return text + "\n";
  }
  std::uint64_t answers = 0, objects = 0;
  for (const SummaryRow& s : table) {
    answers += s.frames.value_or(0);
    objects += s.exact.value_or(0);
  }
  return "No object was missed: " + apps::grouped(static_cast<double>(answers)) + " answers were checked, " +
         apps::grouped(static_cast<double>(objects)) + " objects in view.\n\n";
}

struct Doubts {
  std::size_t rows = 0, few_pairs = 0, dirty = 0, few_processes = 0;
};
Doubts doubts_of(std::span<const SummaryRow> table, const Rules& rules) {
  Doubts d;
  for (const SummaryRow& s : table) {
    if (!s.measured()) continue;
    ++d.rows;
    d.few_pairs += *s.pairs < 50 ? 1 : 0;
    d.few_processes += *s.processes < static_cast<std::uint64_t>(rules.processes) ? 1 : 0;
    d.dirty += *s.dirty > 0 ? 1 : 0;
  }
  return d;
}

constexpr const char* kHow = R"(## How it was timed, and how to read the tables
One thread, unless a case says otherwise. A round is a flight along Pina's figure 4: each query alone between two readings
of the steady clock, less what a reading costs; its time is the median over the frames. A pair is a round of the structure
and one of bqr, in an order that chance decides, in one process. Where time is short a round has fewer frames, spread over
the ranks of their costs so that their median is near that of all, and is flown once untimed before; then fewer pairs. In
cold cases 96 MiB are read and written between two queries.

In the tables of the cases *us* are microseconds a query; of bqr, the median of what it took beside all others. *x bqr* is
the median over the pairs of the structure's time over bqr's (of the logarithm), with its interval; for bqr itself, over a
second bqr: what the method cannot tell apart. *Slower* and *faster* need the whole interval on one side of 1. *exact* are
the objects whose box meets the view, by separating axes in double, in long double where that leaves a doubt; *accepted*
those in the answers, *missed* those that should be; sums over all frames of the flight, in every process again. Structures
of grain *block* accept whole blocks, or pages of blocks, with all that is in them: another task, and an easier one. *none*
accepts everything, in no time. *MB* are 10^6 bytes of the structure with all bounds that it reads. The last column has how
much was measured.

)";

std::string how_text(const Options& options, std::span<const SummaryRow> table) {
  const Rules rules = rules_of(options);
  const Doubts d = doubts_of(table, rules);
  const auto count = [&](std::size_t n) { return std::to_string(n) + " of " + std::to_string(d.rows) + " rows"; };
  std::string text = kHow;
  text += rules.processes == 1
              ? "**Quick**: one process, at least nine pairs; an interval is that of one process (95 % by rank), and "
                "too narrow by itself. "
              : "**Full**: " + std::to_string(rules.processes) +
                    " processes; a figure is the median of their medians, an interval their range (six hold the true "
                    "median with 96.9 %). Fewer processes than that: " +
                    count(d.few_processes) + ". ";
  text += "Fewer than 50 pairs: " + count(d.few_pairs) +
          ". A loop of fixed work before and after each row, and what other programs took, say whether the machine was "
          "left to us; rows for which it was not, in up to " +
          std::to_string(apps::kAttempts) + " attempts, are marked dirty: " + count(d.dirty) + ".\n\n";
  return text;
}

std::string interval(const SummaryRow& s) {
  return apps::digits3(*s.ratio) + " [" + apps::digits3(*s.ratio_lo) + ", " + apps::digits3(*s.ratio_hi) + "]";
}

/// "Faster" needs the whole interval on one side.
std::string finding(const SummaryRow& s) {
  if (s.peer == "bqr") return "";
  if (s.peer == kSmallerCity) return "a smaller city";
  const bool all = *s.accepted == *s.objects * *s.frames;
  const std::string how = all ? ", but accepts all" : s.grain == "block" ? ", but whole blocks" : "";
  if (*s.ratio_lo > 1) return "slower" + how;
  return *s.ratio_hi < 1 ? "faster" + how : "no difference shown";
}

std::vector<std::string> cells(const SummaryRow& s) {
  if (!s.measured()) return {s.peer, s.grain, "not available here", "", "", "", "", "", "", "", ""};
  const double frames = static_cast<double>(*s.frames), exact = static_cast<double>(*s.exact);
  return {s.peer,
          s.grain,
          apps::digits3(*s.median_us),
          interval(s),
          finding(s),
          exact > 0 ? apps::to_cell(static_cast<double>(*s.accepted) / exact) : "-",
          *s.missed > 0 ? "**" + std::to_string(*s.missed) + "**" : "0",
          apps::grouped(static_cast<double>(*s.triangles) / frames),
          apps::digits3(*s.build_ms),
          apps::digits3(static_cast<double>(*s.bytes) / 1e6),
          std::to_string(*s.processes) + " x " + std::to_string(*s.pairs) + " x " + std::to_string(*s.timed_frames) +
              (*s.dirty > 0 ? ", " + std::to_string(*s.dirty) + " dirty" : "")};
}

std::string structures_text(const Options& options) {
  Rows rows{{"structure", "what it is"}};
  for (const std::string& slug : options.peers) rows.push_back({slug, std::string(peer_info(slug)->what)});
  rows.push_back(
      {kSmallerCity, "beside 1M-1km: " + std::string(peer_info(kSmallerCity)->what) + ", on " + kSmallerCase});
  return "## The structures\nAll are asked with the same views, in double, and answer with runs of objects.\n\n" +
         apps::md_table(rows);
}

std::string image(std::span<const std::string> plots, const std::string& name) {
  const bool drawn = std::find(plots.begin(), plots.end(), name) != plots.end();
  return drawn ? "![" + name + "](" + name + ".svg)\n\n" : "";
}

std::string case_text(std::span<const SummaryRow> table, const std::string& name, std::span<const std::string> plots) {
  const std::string what = case_info(name).what;
  std::string text = "## " + name + (what.empty() ? "" : ": " + what) + "\n";
  Rows rows{{"structure", "grain", "us", "x bqr", "than bqr", "accepted / exact", "missed", "triangles a frame",
             "build ms", "MB", "processes x pairs x frames"}};
  for (const SummaryRow& s : table)
    if (s.case_name == name) rows.push_back(cells(s));
  if (const SummaryRow* bqr = find_row(table, name, "bqr"))
    text += apps::grouped(static_cast<double>(*bqr->objects)) + " objects in " +
            apps::grouped(static_cast<double>(*bqr->blocks)) + " blocks, " + std::to_string(*bqr->frames) + " frames." +
            (is_from_file(name) ? " Data \u00a9 OpenStreetMap contributors." : "");
  return text + "\n\n" + apps::md_table(rows) + image(plots, path_plot_name(name));
}

}  // namespace

std::string report_md(const Options& options, std::span<const SummaryRow> table, std::span<const std::string> wrong,
                      std::span<const std::string> plots) {
  std::string text = head_text(options);
  if (table.empty()) return text;
  text += verdict_text(table, wrong) + goals_text(table) + how_text(options, table);
  text += structures_text(options) + rivals_text(table);
  text += image(plots, "size_paper") + image(plots, "size_objects");
  text += growth_text(table) + image(plots, "growth") + trade_text(table);
  for (const TradePlace& place : trade_places()) text += image(plots, place.name);
  for (const std::string& name : cases_of(options)) {
    const Family family = case_info(name).family;
    if (family == Family::speed || family == Family::file) text += case_text(table, name, plots);
  }
  return text;
}

}  // namespace manzana::culling_benchmark

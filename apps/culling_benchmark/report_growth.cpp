#include "apps/culling_benchmark/report_growth.h"

#include "apps/common/markdown.h"
#include "apps/culling_benchmark/growth.h"
#include "apps/culling_benchmark/plots.h"

namespace manzana::culling_benchmark {
namespace {

/// The cases of one kind, by size, as far as they are measured.
using Kind = std::vector<const Growth*>;
Kind kind_of(std::span<const SummaryRow> table, bool all_in_view, bool cold, int threads) {
  Kind kind;
  for (const Growth& g : growth_cases())
    if (g.all_in_view == all_in_view && g.cold == cold && g.threads == threads &&
        find_row(table, g.name, "bqr") != nullptr)
      kind.push_back(&g);
  return kind;
}

std::string cell(std::span<const SummaryRow> table, const Growth& growth, std::string_view peer) {
  const SummaryRow* row = find_row(table, growth.name, peer);
  if (row == nullptr) return "";
  const std::string us = apps::digits3(*row->median_us);
  if (peer == "bqr") return us;
  return us + " (" + apps::digits3(*row->ratio) + " [" + apps::digits3(*row->ratio_lo) + ", " +
         apps::digits3(*row->ratio_hi) + "])";
}

std::string kind_text(std::span<const SummaryRow> table, const char* title, const Kind& kind) {
  if (kind.empty()) return {};
  std::vector<std::vector<std::string>> rows{{"objects"}};
  for (const std::string_view peer : growth_peers()) rows[0].emplace_back(peer);
  rows[0].emplace_back("accepted a frame");
  for (const Growth* growth : kind) {
    rows.push_back({apps::grouped(growth->objects)});
    for (const std::string_view peer : growth_peers()) rows.back().push_back(cell(table, *growth, peer));
    const SummaryRow& bqr = *find_row(table, growth->name, "bqr");
    rows.back().push_back(apps::grouped(static_cast<double>(*bqr.accepted) / static_cast<double>(*bqr.frames)));
  }
  return std::string(title) + "\n\n" + apps::md_table(rows);
}

std::string data_block(std::span<const SummaryRow> table, const char* name, const Kind& kind) {
  std::string text = std::string("$") + name + " << END\n";
  for (const Growth* growth : kind) {
    text += std::to_string(growth->objects);
    for (const std::string_view peer : growth_peers()) {
      const SummaryRow* row = find_row(table, growth->name, peer);
      text += ',';
      text += row != nullptr ? apps::to_cell(*row->median_us) : "?";
    }
    text += '\n';
  }
  return text + "END\n";
}

void add_curves(std::vector<std::string>& parts, std::span<const SummaryRow> table, const char* data, const Kind& kind,
                bool dashed) {
  for (std::size_t i = 0; !kind.empty() && i < growth_peers().size(); ++i) {
    const std::string_view peer = growth_peers()[i];
    if (find_row(table, kind.front()->name, peer) == nullptr) continue;
    std::string part(1, '$');
    part += data;
    part += " using 1:" + std::to_string(i + 2) + " with linespoints pt 7 ps 0.6" + (dashed ? " dt 2" : "");
    part += line_style(peer);
    if (dashed) part.insert(part.size() - 1, ", cold");
    parts.push_back(std::move(part));
  }
}

}  // namespace

std::string growth_text(std::span<const SummaryRow> table) {
  const std::string text = kind_text(table, "All in view:", kind_of(table, true, false, 1)) +
                           kind_text(table, "Seen to 1 km:", kind_of(table, false, false, 1)) +
                           kind_text(table, "Seen to 1 km, cold caches:", kind_of(table, false, true, 1)) +
                           kind_text(table, "Seen to 1 km, two threads at once:", kind_of(table, false, false, 2));
  if (text.empty()) return {};
  return "## How the cost grows\nMicroseconds a query in cities of ever more objects; in brackets times bqr's, "
         "measured side by side. "
         "*All in view*: from outside, so that a query that tells runs need not look at objects. *Seen to 1 km*: what "
         "is in view stays the same once the city is larger than that.\n\n" +
         text;
}

std::vector<apps::Script> growth_plots(std::span<const SummaryRow> table) {
  const Kind all = kind_of(table, true, false, 1), near = kind_of(table, false, false, 1),
             cold = kind_of(table, false, true, 1);
  if (all.size() < 2 || near.size() < 2) return {};
  std::vector<std::string> of_all, of_near;
  add_curves(of_all, table, "all", all, false);
  add_curves(of_near, table, "near", near, false);
  add_curves(of_near, table, "cold", cold, true);
  return {{"growth", apps::gnuplot_head("growth") + data_block(table, "all", all) + data_block(table, "near", near) +
                         data_block(table, "cold", cold) +
                         "set multiplot layout 2,1 title 'How the cost grows'\nset rmargin 24\nset xrange "
                         "[1000:*]\nset logscale xy\nset format y '%g'\n"
                         "set format x '10^{%L}'\nset xlabel 'objects in the city'\n"
                         "set ylabel 'microseconds, all in view'\n" +
                         apps::plot_command(of_all) + "set ylabel 'microseconds, seen to 1 km'\n" +
                         apps::plot_command(of_near) + "unset multiplot\n"}};
}

}  // namespace manzana::culling_benchmark

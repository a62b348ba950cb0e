#include "apps/culling_benchmark/report_trade.h"

#include <algorithm>
#include <array>

#include "apps/common/markdown.h"
#include "apps/culling_benchmark/trade.h"

namespace manzana::culling_benchmark {
namespace {

struct Mark {
  std::string_view name, gnuplot;
};
constexpr std::array kVolumes{Mark{"sphere", "pt 7"}, Mark{"box", "pt 5"}, Mark{"both", "pt 9"},
                              Mark{"exact", "pt 13"}};
constexpr std::array kPrecisions{Mark{"world", "#d62728"}, Mark{"local", "#1f77b4"}, Mark{"relative", "#2ca02c"},
                                 Mark{"double", "#7f7f7f"}};

std::string slug_of(const Mark& volume, const Mark& precision) {
  return std::string(volume.name) + "-" + std::string(precision.name);
}

/// Accepted but not exactly in view, in percent of what is.
double too_many(const SummaryRow& row) {
  return *row.exact > 0 ? 100 * (static_cast<double>(*row.accepted) / static_cast<double>(*row.exact) - 1) : 0;
}

std::string cell(std::span<const SummaryRow> table, const std::string& place, const std::string& slug) {
  const SummaryRow* row = find_row(table, place, slug);
  if (row == nullptr) return "";
  const std::string text = apps::digits3(*row->median_us) + " us, " + apps::digits3(*row->ratio) + " x, " +
                           apps::digits3(too_many(*row)) + " %";
  return (slug != "bqr" && on_front(table, *row) ? "**" + text + "**" : text) +
         (*row->missed > 0 ? ", MISSED " + std::to_string(*row->missed) : "");
}

std::string place_text(std::span<const SummaryRow> table, const TradePlace& place) {
  if (find_row(table, place.name, "bqr") == nullptr) return {};
  std::vector<std::vector<std::string>> rows{{place.name}};
  for (const Mark& precision : kPrecisions) rows[0].emplace_back(precision.name);
  for (const Mark& volume : kVolumes) {
    rows.push_back({std::string(volume.name)});
    for (const Mark& precision : kPrecisions)
      rows.back().push_back(cell(table, place.name, slug_of(volume, precision)));
  }
  return place.what + ":\n\n" + apps::md_table(rows) + "bqr: " + cell(table, place.name, "bqr") + "\n\n";
}

/// A row a volume: times bqr's and percent for each precision.
std::string data_block(std::span<const SummaryRow> table, const TradePlace& place) {
  constexpr double kLeast = 1e-3;  // percent: a logarithmic axis has no zero
  std::string text = "$points << END\n";
  for (const Mark& volume : kVolumes) {
    text += volume.name;
    for (const Mark& precision : kPrecisions) {
      const SummaryRow* row = find_row(table, place.name, slug_of(volume, precision));
      text += ',';
      text +=
          row != nullptr ? apps::to_cell(*row->ratio) + "," + apps::to_cell(std::max(too_many(*row), kLeast)) : "?,?";
    }
    text += '\n';
  }
  return text + "END\n";
}

apps::Script place_plot(std::span<const SummaryRow> table, const TradePlace& place) {
  std::vector<std::string> parts;
  for (std::size_t p = 0; p < kPrecisions.size(); ++p) {
    const std::string columns = std::to_string(2 * p + 2) + ":" + std::to_string(2 * p + 3);
    const std::string colour = " lc rgb " + apps::in_quotes(kPrecisions[p].gnuplot);
    parts.push_back("$points using " + columns + " with lines lw 1.5" + colour + " title " +
                    apps::in_quotes(kPrecisions[p].name));
    for (std::size_t v = 0; v < kVolumes.size(); ++v) {
      const std::string row = std::to_string(v);
      parts.push_back("$points every ::" + row + "::" + row + " using " + columns + " with points ps 1.5 " +
                      std::string(kVolumes[v].gnuplot) + colour + " notitle");
    }
  }
  for (const Mark& volume : kVolumes)
    parts.push_back("keyentry with points ps 1.5 lc rgb 'black' " + std::string(volume.gnuplot) + " title " +
                    apps::in_quotes(volume.name));
  return {place.name, apps::gnuplot_head(place.name) + data_block(table, place) + "set title " +
                          apps::in_quotes(place.what) +
                          "\nset logscale xy\nset format y '%g'\nset xlabel 'time of a query that asks object by "
                          "object, over that of bqr'\n"
                          "set ylabel 'percent accepted too many (0.001: or fewer)'\nset yrange [0.0007:*]\n" +
                          apps::plot_command(parts)};
}

}  // namespace

bool on_front(std::span<const SummaryRow> table, const SummaryRow& row) {
  return std::none_of(table.begin(), table.end(), [&](const SummaryRow& other) {
    if (other.case_name != row.case_name || other.peer == "bqr" || !other.measured()) return false;
    const bool no_worse = *other.ratio <= *row.ratio && *other.accepted <= *row.accepted;
    return no_worse && (*other.ratio < *row.ratio || *other.accepted < *row.accepted);
  });
}

std::string trade_text(std::span<const SummaryRow> table) {
  std::string text;
  for (const TradePlace& place : trade_places()) text += place_text(table, place);
  if (text.empty()) return {};
  return "## Speed for accuracy\nEvery object asked by itself, in plain code: microseconds a query, times bqr's "
         "(measured side by side), and how many "
         "objects "
         "too many are accepted, in percent of those exactly in view. World: float about L's origin; local: float "
         "about "
         "the city's middle; relative: double less the eye, then float. Both: sphere and box; exact: separating axes "
         "of "
         "the box. Bold: nothing else is both quicker and more accurate. All carry the margin that their rounding "
         "needs, "
         "so none may miss an object; without one, see the extremes. Intervals are in summary.csv.\n\n" +
         text;
}

std::vector<SummaryRow> trade_front(std::span<const SummaryRow> table) {
  std::vector<SummaryRow> front;
  for (const SummaryRow& row : table)
    if (find_trade_place(row.case_name) != nullptr && row.peer != "bqr" && row.measured() && on_front(table, row))
      front.push_back(row);
  return front;
}

std::vector<apps::Script> trade_plots(std::span<const SummaryRow> table) {
  std::vector<apps::Script> scripts;
  for (const TradePlace& place : trade_places())
    if (find_row(table, place.name, "bqr") != nullptr) scripts.push_back(place_plot(table, place));
  return scripts;
}

}  // namespace manzana::culling_benchmark

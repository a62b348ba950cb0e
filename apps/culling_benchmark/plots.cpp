#include "apps/culling_benchmark/plots.h"

#include <algorithm>
#include <array>
#include <functional>

#include "apps/culling_benchmark/catalogue.h"
#include "apps/culling_benchmark/measure.h"
#include "apps/culling_benchmark/rules.h"

namespace manzana::culling_benchmark {
namespace {

/// The structures that are drawn: more would hide each other. The last is on top.
struct Line {
  std::string_view peer, colour;
};
constexpr std::array kLines{Line{"none", "#17becf"}, Line{"linear", "#bcbd22"},        Line{"linear-simd", "#7f7f7f"},
                            Line{"osg", "#9467bd"},  Line{"boost-frustum", "#8c564b"}, Line{"vam16", "#2ca02c"},
                            Line{"bvh8", "#1f77b4"}, Line{"bqr-paper", "#ff9896"},     Line{"bqr", "#d62728"}};

apps::Script path_plot(std::span<const SummaryRow> table, const std::string& case_name) {
  std::vector<std::string> times, counts;
  for (const Line& line : kLines) {
    if (line.peer == "none" || find_row(table, case_name, line.peer) == nullptr) continue;
    const std::string file = apps::in_quotes("frames/" + file_name(case_name) + "_" + std::string(line.peer) + ".csv");
    times.push_back(file + " skip 1 using 1:2 with linespoints pt 7 ps 0.25" + line_style(line.peer));
    if (counts.empty()) counts.push_back(file + " skip 1 using 1:4 with lines lw 5 lc rgb '#cccccc' title 'exact'");
    counts.push_back(file + " skip 1 using 1:3 with lines" + line_style(line.peer));
  }
  const std::string name = path_plot_name(case_name);
  return {name,
          apps::gnuplot_head(name) + "set multiplot layout 2,1 title " +
              apps::in_quotes(case_name + ": outskirts, walk in, climb, turn down, dive") +
              " noenhanced\nset xrange [0:*]\nset xlabel 'frame'\nset ylabel 'microseconds a query'\nset logscale y\n"
              "set format y '%g'\n" +
              apps::plot_command(times) + "set ylabel 'objects accepted'\nset format y '%.0f'\n" +
              apps::plot_command(counts) + "unset multiplot\n"};
}

using Value = std::function<double(const SummaryRow&)>;

/// A row a case: its name, the number of objects, and each structure's value.
std::string data_block(std::span<const SummaryRow> table, const std::vector<std::string>& cases, const char* name,
                       const Value& value) {
  std::string text = std::string("$") + name + " << END\n";
  for (const std::string& c : cases) {
    text += c + "," + apps::to_cell(*find_row(table, c, "bqr")->objects);
    for (const Line& line : kLines) {
      const SummaryRow* row = find_row(table, c, line.peer);
      text += ',';
      text += row != nullptr ? apps::to_cell(value(*row)) : "?";
    }
    text += '\n';
  }
  return text + "END\n";
}

std::string curves(std::string_view data, std::string_view x, std::span<const SummaryRow> table,
                   const std::string& any_case) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < kLines.size(); ++i) {
    if (find_row(table, any_case, kLines[i].peer) == nullptr) continue;
    if (kLines[i].peer == "none" && data == "us") continue;  // it takes no time
    std::string part(1, '$');
    part += data;
    part += " using ";
    part += x == "0" ? "0:" + std::to_string(i + 3) + ":xtic(1)" : "2:" + std::to_string(i + 3);
    parts.push_back(part + " with linespoints pt 7 ps 0.6" + line_style(kLines[i].peer));
  }
  return apps::plot_command(parts);
}

/// `x` is gnuplot's column: 0, in the order of the cases, or 2, by objects.
apps::Script size_plot(const std::string& name, std::span<const SummaryRow> table, const std::string& title,
                       const std::vector<std::string>& cases, std::string_view x) {
  const Value us = [](const SummaryRow& s) { return *s.median_us; };
  const Value triangles = [](const SummaryRow& s) {
    return static_cast<double>(*s.triangles) / static_cast<double>(*s.frames);
  };
  const std::string axis = x == "0" ? "set xlabel 'city of the paper'\nset offsets 0.2,0.2,0,0\n"
                                    : "set logscale x\nset format x '10^{%L}'\nset xlabel 'objects in the city'\n";
  return {name, apps::gnuplot_head(name) + data_block(table, cases, "us", us) +
                    data_block(table, cases, "triangles", triangles) + "set multiplot layout 2,1 title " +
                    apps::in_quotes(title) + "\nset logscale y\nset format y '%g'\n" + axis +
                    "set ylabel 'microseconds a query'\n" + curves("us", x, table, cases.front()) +
                    "set ylabel 'triangles accepted a frame'\nset format y '%.0s%c'\n" +
                    curves("triangles", x, table, cases.front()) + "unset multiplot\n"};
}

std::vector<std::string> measured(const std::vector<std::string>& names, std::span<const SummaryRow> table) {
  std::vector<std::string> found;
  for (const std::string& name : names)
    if (find_row(table, name, "bqr") != nullptr) found.push_back(name);
  return found;
}

}  // namespace

std::string path_plot_name(const std::string& case_name) { return "path_" + file_name(case_name); }

std::string line_style(std::string_view peer) {
  const auto line = std::find_if(kLines.begin(), kLines.end(), [&](const Line& l) { return l.peer == peer; });
  const std::string_view colour = line != kLines.end() ? line->colour : "#000000";
  return (peer == "bqr" ? " lw 2.5 lc rgb " : " lw 1.5 lc rgb ") + apps::in_quotes(colour) + " title " +
         apps::in_quotes(peer);
}

std::vector<apps::Script> case_plots(const Options& options, std::span<const SummaryRow> table) {
  std::vector<apps::Script> scripts;
  const auto paper = measured({"C1", "C2", "C3", "C4", "C5", "C6"}, table);
  const auto sizes = measured({"10k", "100k", "1M"}, table);
  if (paper.size() > 1) scripts.push_back(size_plot("size_paper", table, "The cities of the paper", paper, "0"));
  if (sizes.size() > 1) scripts.push_back(size_plot("size_objects", table, "Cities by number of objects", sizes, "2"));
  for (const std::string& name : measured(cases_of(options), table)) {
    const Family family = case_info(name).family;
    if (family == Family::speed || family == Family::file) scripts.push_back(path_plot(table, name));
  }
  return scripts;
}

}  // namespace manzana::culling_benchmark

#include "apps/culling_benchmark/plots.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>

#include "apps/common/whole_file.h"
#include "apps/culling_benchmark/child.h"
#include "apps/culling_benchmark/measure.h"
#include "apps/culling_benchmark/rules.h"

namespace manzana::culling_benchmark {
namespace {

/// The structures that are drawn, each in its colour in all plots: more would hide each other. The last is on top.
struct Line {
  std::string_view peer, colour;
};
constexpr std::array kLines{Line{"none", "#17becf"}, Line{"linear", "#bcbd22"},        Line{"linear-simd", "#7f7f7f"},
                            Line{"osg", "#9467bd"},  Line{"boost-frustum", "#8c564b"}, Line{"vam16", "#2ca02c"},
                            Line{"bvh8", "#1f77b4"}, Line{"bqr-paper", "#ff9896"},     Line{"bqr", "#d62728"}};

std::string in_quotes(std::string_view text) {
  std::string out(1, '\'');
  for (const char c : text) out.append(c == '\'' ? 2 : 1, c);
  return out += '\'';
}

std::string head(const std::string& name) {
  return "set terminal svg size 900,760 dynamic font 'sans-serif,14' background 'white'\nset encoding utf8\n"
         "set output '" +
         name +
         ".svg.part'\nset datafile separator ','\nset datafile missing '?'\n"
         "set grid lt 1 lw 0.5 lc rgb '#cccccc'\nset tics nomirror\nset border 3\n"
         "set key outside right top noenhanced\nset lmargin 12\nset rmargin 20\n";
}

std::string style(const Line& line) {
  return " lw " + std::string(line.peer == "bqr" ? "2.5" : "1.5") + " lc rgb " + in_quotes(line.colour) + " title " +
         in_quotes(line.peer);
}

/// `plot` with the parts behind it.
std::string plot(const std::vector<std::string>& parts) {
  std::string text = "plot ";
  for (const std::string& part : parts) (text += text.size() > 5 ? ", \\\n  " : "") += part;
  return text += '\n';
}

std::string path_script(const std::string& name, std::span<const SummaryRow> table, const std::string& case_name) {
  std::vector<std::string> times, counts;
  for (const Line& line : kLines) {
    if (line.peer == "none" || find_row(table, case_name, line.peer) == nullptr) continue;
    const std::string file = in_quotes("frames/" + file_name(case_name) + "_" + std::string(line.peer) + ".csv");
    times.push_back(file + " skip 1 using 1:2 with lines" + style(line));
    if (counts.empty()) counts.push_back(file + " skip 1 using 1:4 with lines lw 5 lc rgb '#cccccc' title 'exact'");
    counts.push_back(file + " skip 1 using 1:3 with lines" + style(line));
  }
  return head(name) + "set multiplot layout 2,1 title " +
         in_quotes(case_name + ": outskirts, walk in, climb, turn down, dive") +
         " noenhanced\nset xlabel 'frame'\nset ylabel 'microseconds a query'\nset logscale y\nset format y '%g'\n" +
         plot(times) + "set ylabel 'objects accepted'\n" + plot(counts) + "unset multiplot\n";
}

/// Against size: a row a case with a label, the number of objects, and each structure's value.
std::string data_block(std::span<const SummaryRow> table, const std::vector<std::string>& cases, const char* name,
                       const std::function<double(const SummaryRow&)>& value) {
  std::string text = std::string("$") + name + " << END\n";
  for (const std::string& c : cases) {
    const SummaryRow* bqr = find_row(table, c, "bqr");
    text += c + "," + to_cell(*bqr->objects);
    for (const Line& line : kLines) {
      const SummaryRow* row = find_row(table, c, line.peer);
      text += ',';
      text += row != nullptr ? to_cell(value(*row)) : "?";
    }
    text += "\n";
  }
  return text + "END\n";
}

std::string curves(const char* data, bool by_objects, std::span<const SummaryRow> table, const std::string& any_case) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < kLines.size(); ++i) {
    if (find_row(table, any_case, kLines[i].peer) == nullptr) continue;
    if (kLines[i].peer == "none" && std::string_view(data) == "us") continue;  // it takes no time
    std::string part(1, '$');
    part += data;
    part += by_objects ? " using 2:" : " using 0:";
    part += std::to_string(i + 3) + (by_objects ? "" : ":xtic(1)") + " with linespoints pt 7 ps 0.6" + style(kLines[i]);
    parts.push_back(std::move(part));
  }
  return plot(parts);
}

std::string size_script(const std::string& name, std::span<const SummaryRow> table, const std::string& title,
                        const std::vector<std::string>& cases, bool by_objects) {
  const auto us = [](const SummaryRow& s) { return *s.median_us; };
  const auto triangles = [](const SummaryRow& s) {
    return static_cast<double>(*s.triangles) / static_cast<double>(*s.frames);
  };
  return head(name) + data_block(table, cases, "us", us) + data_block(table, cases, "triangles", triangles) +
         "set multiplot layout 2,1 title " + in_quotes(title) + "\nset logscale y\nset format y '%g'\n" +
         (by_objects ? "set logscale x\nset format x '10^{%L}'\nset xlabel 'objects in the city'\n"
                     : "set xlabel 'city of the paper'\nset offsets 0.2,0.2,0,0\n") +
         "set ylabel 'microseconds a query'\n" + curves("us", by_objects, table, cases.front()) +
         "set ylabel 'triangles accepted a frame'\nset format y '%.0s%c'\n" +
         curves("triangles", by_objects, table, cases.front()) + "unset multiplot\n";
}

/// 0 when it is there; 127 without a gnuplot.
int draw(const std::filesystem::path& out, const std::string& name, const std::string& script) {
  apps::make_folder(out / "plots");
  apps::write_whole(out / "plots" / (name + ".gp"), script);
  const std::vector<std::string> command{"sh", "-c", "cd \"$0\" && exec gnuplot \"$1\"", out.string(),
                                         "plots/" + name + ".gp"};
  const int code = run_child(command, [](const std::string&) {});
  if (code == 0) std::filesystem::rename(out / (name + ".svg.part"), out / (name + ".svg"));
  return code;
}

std::vector<std::string> measured(const std::vector<std::string>& names, std::span<const SummaryRow> table) {
  std::vector<std::string> found;
  for (const std::string& name : names)
    if (find_row(table, name, "bqr") != nullptr) found.push_back(name);
  return found;
}

}  // namespace

std::vector<Plot> write_plots(const Options& options, std::span<const SummaryRow> table) {
  std::vector<Plot> plots;
  int worst = 0;
  const auto add = [&](const std::string& name, const std::string& title, const std::string& script) {
    const int code = draw(options.out, name, script);
    if (code == 0) plots.push_back({name + ".svg", title});
    worst = std::max(worst, code);
  };
  const auto paper = measured({"C1", "C2", "C3", "C4", "C5", "C6"}, table);
  const auto sizes = measured({"10k", "100k", "1M"}, table);
  if (paper.size() > 1)
    add("size_paper", "The paper's cities", size_script("size_paper", table, "The paper's cities", paper, false));
  if (sizes.size() > 1)
    add("size_objects", "From 10 000 objects upwards",
        size_script("size_objects", table, "From 10 000 objects upwards", sizes, true));
  for (const std::string& name : measured(cases_of(options), table)) {
    const std::string file = "path_" + file_name(name);
    add(file, "The flight through " + name, path_script(file, table, name));
  }
  if (worst != 0)
    std::fprintf(stderr, "%s: not all plots are drawn; their scripts are in %s\n",
                 worst == 127 ? "gnuplot is not installed" : "gnuplot failed", (options.out / "plots").c_str());
  return plots;
}

}  // namespace manzana::culling_benchmark

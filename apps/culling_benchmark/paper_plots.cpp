#include "apps/culling_benchmark/paper_plots.h"

#include <algorithm>

#include "apps/common/gnuplot.h"
#include "apps/culling_benchmark/paper_rows.h"
#include "apps/culling_benchmark/paper_values.h"

namespace manzana::paper {
namespace {

using apps::Script;
using apps::to_cell;

/// As in the paper: yellow without a structure, red the R-tree, blue the BqR-Tree.
struct Line {
  const char *peer, *colour;
};
constexpr const char *kYellow = "#e0b000", *kRed = "#d62728", *kBlue = "#1f4fb4";
constexpr std::array kLines{Line{"none", kYellow}, Line{"vam-block8", kRed}, Line{"vam-block6", "#ff9896"},
                            Line{"bqr-paper", kBlue}, Line{"bqr", "#17becf"}};

std::string head(const std::string& name, const std::string& title) {
  return apps::gnuplot_head(name) + "set title " + apps::in_quotes(title) +
         " noenhanced\nset yrange [0:*]\nset rmargin 3\nset key outside center bottom horizontal\nset xlabel offset "
         "0,0.6\n";
}

/// One of the columns of $data, after the first.
std::string curve(std::size_t column, const std::string& with, const std::string& colour, const std::string& title) {
  return (column == 2 ? "plot " : ", \\\n  ") + std::string("$data using 1:") + std::to_string(column) + " with " +
         with + " lc rgb '" + colour + "' title '" + title + "'";
}

using Value = std::optional<double>;

std::string data_line(const std::string& x, const std::vector<Value>& values) {
  std::string line = x;
  for (const Value& value : values) {
    line += ',';
    line += value ? apps::to_cell(*value) : "?";
  }
  return line + "\n";
}

Value time_over(const LaneCosts* lane, const LaneCosts* reference) {
  if (lane == nullptr || reference == nullptr) return std::nullopt;
  return mean(*lane, frame_ms) / mean(*reference, frame_ms);
}

/// Against the frame of the flight.
apps::Script flight_plot(const PaperRun& run, const char* name, const std::string& title, const char* axis,
                         Quantity quantity) {
  std::vector<const LaneCosts*> lanes;
  std::string curves;
  for (const Line& line : kLines) {
    const LaneCosts* lane = find_lane(run, {"C2", line.peer});
    if (lane == nullptr) continue;
    lanes.push_back(lane);
    curves += curve(lanes.size() + 1, "lines lw 1.5", line.colour, title_of(line.peer));
  }
  std::string data = "$data << END\n";
  for (std::size_t i = 0; i < lanes[0]->frames.size(); ++i) {
    if (!lanes[0]->frames[i].measured) continue;
    std::vector<Value> values;
    for (const LaneCosts* lane : lanes) values.emplace_back(quantity(lane->frames[i]));
    data += data_line(std::to_string(i + 1), values);
  }
  return {name, head(name, title) + "set xrange [0:" + std::to_string(run.options.frames + 1) +
                    "]\nset xlabel 'frame'\nset ylabel '" + axis + "'\n" + data + "END\n" + curves + "\n"};
}

/// Triangles and time over those of C1.
apps::Script size_plot(const PaperRun& run) {
  const std::string name = "paper_fig8", title = "Figure 8: triangles and time over those of C1";
  const LaneCosts* c1 = find_lane(run, {"C1", "bqr-paper"});
  std::string data = "$data << END\n";
  for (const PaperCity& city : kPaperCities) {
    const std::string of(city.name);
    const LaneCosts* lane = find_lane(run, {of, "bqr-paper"});
    if (lane == nullptr) continue;
    const double triangles = static_cast<double>(lane->city_triangles) / static_cast<double>(c1->city_triangles);
    data += data_line(of, {triangles, time_over(lane, c1), city.times_c1, city.bqr_s / kPaperCities[0].bqr_s});
  }
  const auto points = [](std::size_t column, const std::string& with, const char* colour, const char* of) {
    const std::string use = column == 2 ? "plot $data" : ", \\\n  $data";
    return use + " using 0:" + std::to_string(column) + ":xtic(1) with " + with + " lc rgb '" + colour + "' title '" +
           of + "'";
  };
  return {name, head(name, title) + "set offsets 0.2,0.2,0,0\nset ylabel 'over C1'\n" + data + "END\n" +
                    points(2, "linespoints pt 7 lw 2", kYellow, "triangles, ours") +
                    points(3, "linespoints pt 7 lw 2", kBlue, "time, ours") +
                    points(4, "points pt 6 ps 1.4", kYellow, "triangles, paper") +
                    points(5, "linespoints pt 6 ps 1.4 dt 2", kBlue, "time, paper") + "\n"};
}

/// The paper's table 3 has only cars with levels of detail in figures; its figure 9 is a picture.
apps::Script cars_plot(const PaperRun& run) {
  const std::string name = "paper_fig9", title = "Figure 9 and table 3: time a frame over that of C2 without cars";
  std::string data = "$data << END\n";
  for (const std::uint32_t cars : {100U, 1'000U, 10'000U}) {
    std::vector<Value> values;
    for (const std::size_t levels : {kOneLevel.size(), kFiveLevels.size()})
      for (const char* peer : {"vam-block8", "bqr-paper"})
        values.push_back(
            time_over(find_lane(run, {"C2", peer, levels, cars}), find_lane(run, {"C2", peer, kOneLevel.size(), 0})));
    const auto* paper =
        std::find_if(kPaperCars.begin(), kPaperCars.end(), [&](const PaperCars& p) { return p.cars == cars; });
    const bool known = paper != kPaperCars.end();
    values.push_back(known ? Value(paper->vam_s / kPaperVam.seconds) : std::nullopt);
    values.push_back(known ? Value(paper->bqr_s / kPaperBqr.seconds) : std::nullopt);
    data += data_line(std::to_string(cars), values);
  }
  return {name, head(name, title) + "set logscale x\nset xlabel 'cars'\nset ylabel 'over no cars'\n" + data + "END\n" +
                    curve(2, "linespoints pt 7 lw 2", kRed, "VAMSplit 8, 387 triangles") +
                    curve(3, "linespoints pt 7 lw 2", kBlue, "BqR, 387 triangles") +
                    curve(4, "linespoints pt 5 lw 2", "#ff9896", "VAMSplit 8, levels") +
                    curve(5, "linespoints pt 5 lw 2", "#8fb0e8", "BqR, levels") +
                    curve(6, "linespoints pt 6 ps 1.4 dt 2", kRed, "VAMSplit, levels, paper") +
                    curve(7, "linespoints pt 6 ps 1.4 dt 2", kBlue, "BqR, levels, paper") + "\n"};
}

}  // namespace

std::vector<apps::Script> paper_plots(const PaperRun& run) {
  std::vector<apps::Script> plots;
  if (find_lane(run, {"C2", "none"}) != nullptr) {
    plots.push_back(
        flight_plot(run, "paper_fig5", "Figure 5: time per frame of the flight, C2", "milliseconds", frame_ms));
    plots.push_back(
        flight_plot(run, "paper_fig6", "Figure 6: triangles per frame of the flight, C2", "triangles", triangle_count));
  }
  if (find_lane(run, {"C1", "bqr-paper"}) != nullptr) plots.push_back(size_plot(run));
  if (find_lane(run, {"C2", "bqr-paper", 1, 0}) != nullptr) plots.push_back(cars_plot(run));
  return plots;
}

}  // namespace manzana::paper

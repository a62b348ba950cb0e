#include "apps/foliage_benchmark/trade_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "apps/common/markdown.h"
#include "apps/foliage_benchmark/errors_report.h"

namespace manzana::foliage_benchmark {
namespace {

using apps::digits3;

struct Measure {
  const char* name;
  const char* title;
  double (*error)(const TradePoint&);
  double TradePoint::*within;
  double (*limit)(const TradePoint&);
};
const std::array<Measure, 4> kMeasures{
    {{"cover", "cover, off by", [](const TradePoint& p) { return std::abs(p.cover - 1); }, &TradePoint::cover_within,
      [](const TradePoint&) { return kCoverWithin; }},
     {"colour", "mean colour, off by", [](const TradePoint& p) { return p.colour; }, &TradePoint::colour_within,
      [](const TradePoint&) { return kColourWithin; }},
     {"ssim", "1 - SSIM", [](const TradePoint& p) { return 1 - p.ssim; }, &TradePoint::ssim_within,
      [](const TradePoint& p) { return 1 - p.floor_ssim; }},
     {"gmsd", "GMSD", [](const TradePoint& p) { return p.gmsd; }, &TradePoint::gmsd_within,
      [](const TradePoint& p) { return p.floor_gmsd; }}}};

std::vector<std::string> names_of(std::span<const TradePoint> points) {
  std::vector<std::string> names;
  for (const TradePoint& p : points)
    if (std::ranges::find(names, p.plant) == names.end()) names.push_back(p.plant);
  return names;
}

std::string slug(std::string name) {
  std::erase(name, ',');
  std::ranges::replace(name, ' ', '_');
  return name;
}

/// What is drawn alike: a law; of a wood, which has ours alone, what is on the front, and what is not.
std::string series_of(const TradePoint& p) {
  return p.plant == kWood && p.law != "full" && p.front.empty() ? "beaten" : p.law;
}

/// From little error to much, or by primitives.
std::vector<TradePoint> points_of(std::span<const TradePoint> points, const std::string& plant,
                                  const std::string& series, double height) {
  std::vector<TradePoint> some;
  for (const TradePoint& p : points)
    if (p.plant == plant && series_of(p) == series && p.height_px == height) some.push_back(p);
  if (plant == kWood) std::ranges::stable_sort(some, std::greater<>(), &TradePoint::primitives_ratio);
  return some;
}

/// Share of primitives, error, its interval, limit, of those that a profile uses.
std::string curve(std::span<const TradePoint> points, const Measure& m) {
  constexpr double kLeast = 1e-4;  // a logarithmic axis has no zero
  std::string text;
  for (const TradePoint& p : points) {
    const double error = std::max(m.error(p), kLeast), within = std::min(p.*m.within, 9.0);
    text += apps::to_cell(std::max(p.primitives_ratio, 1e-6));
    for (const double v : {error, std::max(error - within, kLeast), error + within, m.limit(p)})
      (text += ',') += apps::to_cell(v);
    (text += ',') += p.profiles.empty() ? std::string("?") : apps::to_cell(error);
    text += '\n';
  }
  return text;
}

/// Ours as a line for each height, with whiskers, its limit dotted, the ways of the profiles ringed; other laws as
/// marks.
std::string panel(std::span<const TradePoint> points, const std::string& plant, const Measure& m, bool with_key) {
  std::set<double, std::greater<>> heights;
  std::vector<std::string> laws;
  for (const TradePoint& p : points) {
    if (p.plant != plant || p.law == "full") continue;
    heights.insert(p.height_px);
    if (std::ranges::find(laws, series_of(p)) == laws.end()) laws.push_back(series_of(p));
  }
  std::string text = "set title " + apps::in_quotes(m.title) + (with_key ? "\nset key\n" : "\nunset key\n");
  std::vector<std::string> parts;
  int colour = 0, block = 0;
  for (const double height : heights) {
    const std::string lc = " lc " + std::to_string(++colour);
    for (std::size_t law = 0; law < laws.size(); ++law) {
      const std::string rows = curve(points_of(points, plant, laws[law], height), m);
      if (rows.empty()) continue;
      const std::string data = std::string("$") + m.name + std::to_string(block++);
      text += data + " << E\n" + rows + "E\n";
      if (laws[law] != "ours") {
        parts.push_back(data + " using 1:2 with points ps 0.5 pt " + std::to_string(3 + 2 * law) + lc + " notitle");
        continue;
      }
      parts.push_back(data + " using 1:2 with lines lw 1.5" + lc + " title " +
                      apps::in_quotes(digits3(height) + " px"));
      parts.push_back(data + " using 1:2:3:4 with yerrorbars pt 0 ps 0.1 lw 0.5" + lc + " notitle");
      parts.push_back(data + " using 1:5 with lines dt 3" + lc + " notitle");
      parts.push_back(data + " using 1:6 with points pt 6 ps 1.2 lw 1.5" + lc + " notitle");
    }
  }
  for (std::size_t law = 0; law < laws.size(); ++law)
    if (laws[law] != "ours")
      parts.push_back("keyentry with points ps 0.5 pt " + std::to_string(3 + 2 * law) + " lc 'black' title " +
                      apps::in_quotes(laws[law]));
  return text + apps::plot_command(parts);
}

apps::Script plot_of(std::span<const TradePoint> points, const std::string& plant) {
  apps::Script script{"pareto_" + slug(plant), apps::gnuplot_head("pareto_" + slug(plant))};
  script.text +=
      "set multiplot layout 2,2 title " +
      apps::in_quotes(plant +
                      ": error over the share of all detail's primitives; dotted: a height's limit; rings: profiles") +
      "\nset logscale xy\nset format '%g'\nset rmargin 3\nset key inside left bottom font ',9' samplen 1 opaque\n";
  for (const Measure& m : kMeasures) script.text += panel(points, plant, m, &m == &kMeasures[1]) + "\n";
  script.text += "unset multiplot\n";
  return script;
}

std::vector<std::string> cells_of(const TradePoint& p) {
  const auto with = [](double value, double within) { return digits3(value) + " +- " + digits3(within); };
  return {p.plant,
          digits3(p.height_px),
          way_name(p),
          digits3(p.primitives_ratio),
          p.ratio ? digits3(*p.ratio) + " [" + digits3(*p.ratio_lo) + ", " + digits3(*p.ratio_hi) + "]" : "",
          with(p.cover, p.cover_within),
          with(p.colour, p.colour_within),
          with(p.ssim, p.ssim_within) + " (" + digits3(p.floor_ssim) + ")",
          with(p.gmsd, p.gmsd_within) + " (" + digits3(p.floor_gmsd) + ")",
          p.pop ? digits3(*p.pop) : "",
          digits3(worst_over(p, 1)),
          p.profiles};
}

std::string front_table(std::span<const TradePoint> points) {
  std::vector<std::vector<std::string>> cells{{"plant", "height px", "way", "primitives, of all", "times as fast",
                                               "cover", "colour", "SSIM (floor)", "GMSD (floor)", "pop",
                                               "worst over limit", "profiles"}};
  for (const TradePoint& p : points)
    if (!p.front.empty() && (p.plant == kAllPlants || is_stand(p.plant))) cells.push_back(cells_of(p));
  return apps::md_table(cells);
}

/// How often each law is on a front.
std::string laws_md(std::span<const TradePoint> points) {
  std::map<std::string, std::pair<int, int>> laws;
  for (const TradePoint& p : points) {
    if (p.law == "full" || p.plant == kAllPlants || p.plant == kWood) continue;
    laws[p.law].first += p.front.empty() ? 0 : 1;
    ++laws[p.law].second;
  }
  std::string text;
  for (const auto& [law, counts] : laws)
    text += "- " + law + ": " + std::to_string(counts.first) + " of " + std::to_string(counts.second) +
            " points are on the front of their plant or stand and height.\n";
  return text + "\n";
}

}  // namespace

std::span<const apps::Column<TradePoint>> trade_columns() {
  using C = apps::Column<TradePoint>;
  static const auto columns = apps::joined<TradePoint>(
      {verdict_columns_of<TradePoint>(),
       {C{"views", "", "that the means are of", &TradePoint::views},
        C{"cover_within", "", "the mean's 95 % interval: so much to either side", &TradePoint::cover_within},
        C{"colour_within", "", "", &TradePoint::colour_within}, C{"ssim_within", "", "", &TradePoint::ssim_within},
        C{"gmsd_within", "", "", &TradePoint::gmsd_within},
        C{"pop", "",
          "by how much the worst frame of an approach steps more than all detail does, over all detail's own worst "
          "step",
          &TradePoint::pop},
        C{"primitives_ratio", "", "of all detail's", &TradePoint::primitives_ratio},
        C{"ratio", "", "times as fast as all detail, sampled as the product does", &TradePoint::ratio},
        C{"ratio_lo", "", "of its 95 % interval, within one process", &TradePoint::ratio_lo},
        C{"ratio_hi", "", "", &TradePoint::ratio_hi},
        C{"front", "", "front: nothing at that height costs less and errs less", &TradePoint::front},
        C{"profiles", "", "of quality that use this way", &TradePoint::profiles}}});
  return columns;
}

std::string quality_csv(std::span<const Profile> profiles) {
  std::string text = "name,tree_law,tree_error_px,samples\n";
  for (const Profile& p : profiles)
    text += p.name + "," + p.law + "," + apps::to_cell(p.error_px) + "," + apps::to_cell(p.samples) + "\n";
  return text;
}

std::string trade_md(std::span<const TradePoint> points, std::span<const Profile> profiles, const TradePlan& plan) {
  std::string text =
      "## Speed for accuracy\n\nEach law of detail over the error that it is told may be wrong: " +
      std::to_string(plan.errors.settings.size()) + " ways, " + std::to_string(plan.errors.views) +
      " views of each plant at each height, and of a closed stand of " + std::to_string(plan.stand_trees) +
      " trees from its edge, inside and above. Of a block of a closed wood of " + std::to_string(plan.wood_trees) +
      " trees from afar " + std::to_string(plan.far.views) +
      " views by each knob of mosaics and groves, with the error of `--quality balanced`: heights in errors under "
      "which trees are mosaics, and the block a grove, of so many points a square of the error. Errors are of finely "
      "sampled pictures against all detail (the model alone), means with their 95 % interval; the limits are cover "
      "within 0.02, colour within 0.005, and structure no farther off than the floor: all detail moved by half a "
      "pixel, or sampled with 4 samples. Pop: the camera comes nearer by 1 % a frame, and the worst frame steps by so "
      "much more than all detail does, over all detail's own worst step; at most " +
      digits3(kMostPop) +
      " is meant, twice as much in all. Times are the median of paired runs in this process.\n\nA profile of quality "
      "is the way with the fewest primitives (geometric mean over heights) whose every error, with its interval, is "
      "under `allowed` times the limit at every height of all plants together, and of which no plant pops; stands and "
      "woods are shown beside, and do not decide. `cp DIR/quality.csv scenegraph/draw/` makes these the "
      "walkthrough's.\n\n";
  std::vector<std::vector<std::string>> cells{
      {"profile", "allowed", "law", "error px", "samples", "primitives, of all detail's"}};
  for (const Profile& p : profiles)
    cells.push_back({p.name, digits3(p.allowed), p.law, digits3(p.error_px), std::to_string(p.samples),
                     digits3(p.primitives_ratio)});
  return text + apps::md_table(cells) + laws_md(points) +
         "### The front, of all plants together, of the stands and of the wood\n\n" + front_table(points);
}

std::vector<apps::Script> trade_plots(std::span<const TradePoint> points) {
  std::vector<apps::Script> scripts;
  for (const std::string& name : names_of(points)) scripts.push_back(plot_of(points, name));
  return scripts;
}

}  // namespace manzana::foliage_benchmark

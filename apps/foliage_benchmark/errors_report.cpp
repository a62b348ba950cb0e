#include "apps/foliage_benchmark/errors_report.h"

#include <algorithm>
#include <array>

#include "apps/common/markdown.h"

namespace manzana::foliage_benchmark {
namespace {

using apps::digits3;

std::vector<std::string> cells_of(const Verdict& v, const Verdict& all) {
  return {v.plant,
          digits3(v.height_px),
          v.law,
          apps::grouped(static_cast<double>(v.primitives)),
          digits3(static_cast<double>(all.primitives) / std::max(1.0, static_cast<double>(v.primitives))),
          digits3(v.cover),
          digits3(v.colour),
          digits3(v.ssim) + " (" + digits3(v.floor_ssim) + ")",
          digits3(v.gmsd) + " (" + digits3(v.floor_gmsd) + ")",
          digits3(v.iou),
          v.over.empty() ? "under" : v.over};
}

const Verdict& full_of(std::span<const Verdict> verdicts, const Verdict& v) {
  return *std::find_if(verdicts.begin(), verdicts.end(), [&](const Verdict& full) {
    return full.law == "full" && full.plant == v.plant && full.height_px == v.height_px;
  });
}

std::string table_of(std::span<const Verdict> verdicts, std::string_view sampling, bool floors) {
  std::vector<std::vector<std::string>> cells{{"plant", "height px", "law", "primitives", "fewer by", "cover", "colour",
                                               "SSIM (floor)", "GMSD (floor)", "IoU", "over the floor"}};
  for (const Verdict& v : verdicts)
    if (v.sampling == sampling && (floors || v.law != "full")) cells.push_back(cells_of(v, full_of(verdicts, v)));
  return apps::md_table(cells);
}

std::string count_md(std::span<const Verdict> verdicts, std::string_view law, std::string_view sampling) {
  std::size_t all = 0, under = 0;
  for (const Verdict& v : verdicts) {
    if (v.law != law || v.sampling != sampling) continue;
    ++all;
    under += v.over.empty() ? 1 : 0;
  }
  return std::to_string(under) + " of " + std::to_string(all);
}

std::string rows_of(std::span<const Verdict> verdicts, const std::string& plant, std::string_view law,
                    std::string_view sampling) {
  std::string rows;
  for (const Verdict& v : verdicts)
    if (v.plant == plant && v.law == law && v.sampling == sampling)
      rows += apps::to_cell(v.height_px) + "," + apps::to_cell(v.primitives) + "," + apps::to_cell(v.cover) + "," +
              apps::to_cell(v.gmsd) + "," + apps::to_cell(v.floor_gmsd) + "\n";
  return rows;
}

apps::Script plot_of(std::span<const Verdict> verdicts, const std::string& plant) {
  apps::Script script{"errors_" + plant, apps::gnuplot_head("errors_" + plant)};
  script.text += "$ours << E\n" + rows_of(verdicts, plant, "ours", "product") + "E\n$gumbau << E\n" +
                 rows_of(verdicts, plant, "gumbau", "product") + "E\n$full << E\n" +
                 rows_of(verdicts, plant, "full", "product") + "E\n";
  script.text += "set title " + apps::in_quotes(plant + ", as the product samples") +
                 "\nset logscale x 2\nset xlabel 'height of the plant, pixels'\nset ylabel 'cover, and GMSD'\n"
                 "set y2label 'primitives'\nset logscale y2\nset y2tics\nset ytics nomirror\nset yrange [0:*]\n";
  script.text += apps::plot_command({"$ours using 1:3 with linespoints title 'cover, ours'",
                                     "$gumbau using 1:3 with linespoints title 'cover, gumbau'",
                                     "$full using 1:3 with linespoints title 'cover, full'",
                                     "$ours using 1:4 with linespoints title 'GMSD, ours'",
                                     "$ours using 1:5 with lines dashtype 2 title 'GMSD, floor'",
                                     "$ours using 1:2 axes x1y2 with linespoints title 'primitives, ours'",
                                     "$full using 1:2 axes x1y2 with linespoints title 'primitives, full'"});
  return script;
}

}  // namespace

std::span<const apps::Column<ErrorRow>> error_columns() {
  static const auto columns = apps::joined<ErrorRow>(
      {apps::run_columns<ErrorRow>(),
       picture_columns<ErrorRow>(),
       {{"azimuth_deg", "degrees", "of the camera", &ErrorRow::azimuth_deg},
        {"elevation_deg", "degrees", "of the camera over the plant's middle", &ErrorRow::elevation_deg}}});
  return columns;
}

std::span<const apps::Column<Verdict>> verdict_columns() {
  static const auto columns = verdict_columns_of<Verdict>();
  return columns;
}

std::string errors_md(std::span<const Verdict> verdicts, const ErrorPlan& plan) {
  std::string text = "## Image errors against all detail\n\n";
  text += "Means over " + std::to_string(plan.views) +
          " views. The reference is all detail, at least 4 x 4 samples a pixel and the plant at least "
          "768 samples high; floors are the reference moved by half a pixel, and all detail as the product samples it "
          "(4 samples a pixel). Cover may be off by 0.02, the mean colour by 0.005. The error that "
          "may be made is " +
          digits3(plan.settings.front().error_px) + " px.\n\n";
  for (const Setting& setting : plan.settings)
    text += "- " + std::string(name_of(setting.law)) + ": " + count_md(verdicts, name_of(setting.law), "product") +
            " pairs of plant and height are under every floor as the product samples them, " +
            count_md(verdicts, name_of(setting.law), "fine") + " by the model alone.\n";
  text += "\n### As the product samples\n\n" + table_of(verdicts, "product", true);
  text += "### The model alone, sampled as the reference\n\n" + table_of(verdicts, "fine", false);
  return text;
}

std::vector<apps::Script> error_plots(std::span<const Verdict> verdicts) {
  std::vector<std::string> plants;
  std::vector<apps::Script> scripts;
  for (const Verdict& v : verdicts) {
    if (std::find(plants.begin(), plants.end(), v.plant) != plants.end()) continue;
    plants.push_back(v.plant);
    scripts.push_back(plot_of(verdicts, v.plant));
  }
  return scripts;
}

}  // namespace manzana::foliage_benchmark

#include "apps/foliage_benchmark/benchmark.h"

#include <cmath>
#include <cstdio>

#include "apps/common/machine.h"
#include "apps/common/markdown.h"
#include "apps/common/png.h"
#include "apps/common/progress_bar.h"
#include "apps/foliage_benchmark/errors_report.h"
#include "apps/foliage_benchmark/popping.h"
#include "apps/foliage_benchmark/times.h"
#include "files/whole_file.h"
#include "foliage/import/load_plant.h"
#include "foliage/import/species.h"
#include "gl/context.h"

namespace manzana::foliage_benchmark {
namespace {

std::vector<foliage::PreparedPlant> plants_of(const Options& options) {
  std::vector<foliage::PreparedPlant> plants;
  apps::ProgressBar bar(stderr);
  const auto tell = [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); };
  const auto preparing = [&](const std::string& name) {
    foliage::PrepareOptions how;
    how.progress = [&bar, name](double done) { bar.show("preparing " + name, done); };
    return how;
  };
  for (const std::string& text : options.plants) {
    const foliage::PlantSource source = foliage::parse_plant_source(text);
    plants.push_back(load_or_prepare(source, foliage::default_cache_folder(), preparing(text), tell));
    plants.back().name = source.file.stem().string();
  }
  if (!options.plants.empty()) return plants;
  for (const std::string_view name : foliage::kSpeciesNames) {
    if (options.quick && plants.size() == 2) break;
    plants.push_back(prepare(grow_plant(foliage::builtin_species(name), 1), preparing(std::string(name))));
    plants.back().name = name;
  }
  return plants;
}

ErrorPlan plan_of(const Options& options) {
  ErrorPlan plan;
  plan.error_px = options.error_px;
  if (options.quick) {
    plan.heights = {128, 32, 12};
    plan.views = 2;
  }
  if (!options.heights.empty()) plan.heights = options.heights;
  if (options.views) plan.views = *options.views;
  return plan;
}

void write_picture(const std::filesystem::path& file, const Picture& picture) {
  apps::write_png(file, picture.width, picture.height, to_rgb8(picture));
}

constexpr std::array kSheetHeights{256.0, 128.0, 64.0, 32.0, 16.0};

void write_sheets(const Options& options, std::span<const foliage::PreparedPlant> plants) {
  Stage stage(plants, sites_of(plants));
  for (std::uint32_t i = 0; i < plants.size(); ++i)
    write_picture(options.out / ("sheet_" + plants[i].name + ".png"),
                  contact_sheet(stage, i, extent_of(plants[i]), foliage::Law::ours, options.error_px, kSheetHeights));
}

std::vector<Verdict> write_errors(const Options& options, std::span<const foliage::PreparedPlant> plants,
                                  const ErrorPlan& plan) {
  apps::ProgressBar bar(stderr);
  const auto rows = measure_errors(plants, plan, [&](double done) { bar.show("image errors", done); });
  auto verdicts = judge(rows);
  files::write_whole(options.out / "runs.csv", apps::to_csv<ErrorRow>(rows, error_columns()));
  files::write_whole(options.out / "summary.csv", apps::to_csv<Verdict>(verdicts, verdict_columns()));
  return verdicts;
}

std::string write_popping(const Options& options, std::span<const foliage::PreparedPlant> plants) {
  PopPlan plan;
  plan.error_px = options.error_px;
  if (options.quick) plan = {{64}, 1.4, options.error_px, nullptr};
  apps::ProgressBar bar(stderr);
  std::vector<PopRow> rows;
  for (const Popped& popped : measure_popping(plants, plan, [&](double done) { bar.show("popping", done); })) {
    const PopRow& row = rows.emplace_back(popped.row);
    const std::string name =
        "popping_" + row.plant + "_" + row.moving + "_" + std::to_string(std::lround(row.height_px)) + ".png";
    write_picture(options.out / name, popped.sheet);
  }
  files::write_whole(options.out / "popping.csv", apps::to_csv<PopRow>(rows, pop_columns()));
  return popping_md(rows);
}

std::string columns_md() {
  return "# Columns\n\n## runs.csv: one picture each\n" + apps::explain(error_columns()) +
         "\n## summary.csv: means over the views\n" + apps::explain(verdict_columns()) +
         "\n## popping.csv: faded against unfaded\n" + apps::explain(pop_columns()) +
         "\n## times.csv: two ways timed in turn\n" + apps::explain(time_columns());
}

std::string head_md(const Options& options, std::span<const foliage::PreparedPlant> plants) {
  const apps::Machine& machine = apps::this_machine();
  std::string text =
      "# Plants: what they cost and how true they look\n\nmanzana-foliage-benchmark " MANZANA_VERSION ", commit " +
      machine.commit + ", " + apps::now_utc() + ", " + machine.processor + ", " + gl::renderer_name() + ".\n";
  if (options.quick) text += "A quick run: few plants, views, distances and repetitions.\n";
  if (gl::software_renderer())
    text += "GL runs in software here: its times mean nothing by themselves, only their ratios within one row do.\n";
  std::vector<std::vector<std::string>> cells{
      {"plant", "height m", "branch quads", "leaf quads", "lines", "points", "cells", "leaf area m2"}};
  for (const foliage::PreparedPlant& p : plants) {
    const auto count = [](std::size_t n) { return apps::grouped(static_cast<double>(n)); };
    const std::size_t bark = p.branch_levels.empty() ? 0 : p.branch_levels.front().quads.size();
    cells.push_back({p.name, apps::digits3(static_cast<double>(p.height_m)), count(bark), count(p.leaves.size()),
                     count(p.lines.size()), count(p.points.size()), count(p.cells.size()),
                     apps::digits3(static_cast<double>(p.leaf_area_m2))});
  }
  return text + "\n" + apps::md_table(cells);
}

std::string plots_md(const std::vector<std::string>& drawn) {
  std::string text = drawn.empty() ? "" : "## Plots\n\n";
  for (const std::string& name : drawn) text += "![" + name + "](" + name + ".svg)\n";
  return text;
}

}  // namespace

int run_benchmark(const Options& options) {
  files::make_folder(options.out);
  const gl::HeadlessContext context;
  const auto plants = plants_of(options);
  const ErrorPlan plan = plan_of(options);
  const auto verdicts = write_errors(options, plants, plan);
  const std::string popping = write_popping(options, plants);
  write_sheets(options, plants);
  const Times times = options.errors_only ? Times{} : measure_times(options.quick, plants);
  if (!times.rows.empty())
    files::write_whole(options.out / "times.csv", apps::to_csv<TimeRow>(times.rows, time_columns()));
  files::write_whole(options.out / "columns.md", columns_md());
  auto plots = error_plots(verdicts);
  plots.insert(plots.end(), times.plots.begin(), times.plots.end());
  const auto drawn = apps::draw_all(options.out, plots);
  files::write_whole(options.out / "report.md",
                     head_md(options, plants) + errors_md(verdicts, plan) + popping + times.text + plots_md(drawn));
  std::printf("written to %s; read report.md first\n", options.out.c_str());
  return 0;
}

}  // namespace manzana::foliage_benchmark

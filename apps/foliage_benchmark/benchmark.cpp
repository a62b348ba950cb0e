#include "apps/foliage_benchmark/benchmark.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <numeric>

#include "apps/common/child.h"
#include "apps/common/machine.h"
#include "apps/common/markdown.h"
#include "apps/common/progress_bar.h"
#include "apps/foliage_benchmark/contact_sheet.h"
#include "apps/foliage_benchmark/errors_report.h"
#include "apps/foliage_benchmark/forest_path.h"
#include "apps/foliage_benchmark/from_above.h"
#include "apps/foliage_benchmark/popping.h"
#include "apps/foliage_benchmark/times.h"
#include "apps/foliage_benchmark/trade_report.h"
#include "files/whole_file.h"
#include "foliage/import/load_plant.h"
#include "foliage/import/species.h"
#include "gl/context.h"

namespace manzana::foliage_benchmark {
namespace {

std::string mode_of(const Options& options) { return options.quick ? "quick" : "full"; }

std::vector<std::string> plant_names(const Options& options) {
  if (!options.plants.empty()) return options.plants;
  return {foliage::kSpeciesNames.begin(), foliage::kSpeciesNames.begin() + (options.quick ? 2 : 11)};
}

foliage::PreparedPlant plant_of(const Options& options, const std::string& text, const foliage::PrepareOptions& how,
                                const foliage::TellLine& tell) {
  foliage::PreparedPlant plant;
  if (options.plants.empty()) {
    plant = prepare(grow_plant(foliage::builtin_species(text), 1), how);
    plant.name = text;
  } else {
    const foliage::PlantSource source = foliage::parse_plant_source(text);
    plant = load_or_prepare(source, foliage::default_cache_folder(), how, tell);
    plant.name = source.file.stem().string();
  }
  return plant;
}

/// Side by side.
std::vector<foliage::PreparedPlant> plants_of(const Options& options) {
  const auto names = plant_names(options);
  std::vector<foliage::PreparedPlant> plants(names.size());
  std::vector<double> done(names.size());
  apps::ProgressBar bar(stderr);
  std::mutex mutex;
  const auto tell = [&](const std::string& line) {
    const std::scoped_lock lock(mutex);
    std::fprintf(stderr, "%s\n", line.c_str());
  };
  tbb::parallel_for(std::size_t{0}, names.size(), [&](std::size_t i) {
    foliage::PrepareOptions how;
    if (options.quick) how.visibility_side = 5;
    how.progress = [&, i](double fraction) {
      const std::scoped_lock lock(mutex);
      done[i] = fraction;
      bar.show("preparing", std::accumulate(done.begin(), done.end(), 0.0) / static_cast<double>(done.size()),
               names[i]);
    };
    plants[i] = plant_of(options, names[i], how, tell);
  });
  return plants;
}

void set_asked(const Options& options, ErrorPlan& plan) {
  if (!options.heights.empty()) plan.heights = options.heights;
  if (options.views) plan.views = *options.views;
}

ErrorPlan plan_of(const Options& options) {
  ErrorPlan plan;
  for (Setting& setting : plan.settings) setting.error_px = options.error_px;
  plan.mode = mode_of(options);
  if (options.quick) {
    plan.heights = {128, 32, 12};
    plan.views = 2;
  }
  set_asked(options, plan);
  return plan;
}

void write_sheets(const Options& options, std::span<const foliage::PreparedPlant> plants) {
  constexpr std::array kHeights{240.0, 120.0, 60.0, 30.0, 15.0};
  Stage stage(plants, sites_of(plants));
  for (std::uint32_t i = 0; i < plants.size(); ++i)
    write_sheet(options.out / ("sheet_" + plants[i].name + ".png"),
                contact_sheet(stage, i, kHeights, options.error_px));
}

/// Rows of this run, of plants as they are now; of stands and woods of them, whose leaves are not all in view, by the
/// bark that they have in full.
apps::Record<ErrorRow> error_record(const Options& options, std::span<const foliage::PreparedPlant> plants,
                                    const std::vector<std::uint64_t>& bark = {}) {
  const apps::RunFacts facts = apps::run_facts(mode_of(options));
  return {options.out / "runs.csv", error_columns(), [=](const ErrorRow& row) {
            const bool full = row.law == "full";
            const auto same_plant = [&](const foliage::PreparedPlant& p) {
              return p.name == row.plant && (!full || row.leaves == p.leaves.size());
            };
            return same_run(row, facts) &&
                   ((is_stand(row.plant) && (!full || std::ranges::find(bark, row.bark) != bark.end())) ||
                    std::any_of(plants.begin(), plants.end(), same_plant));
          }};
}

std::vector<Verdict> write_errors(const Options& options, std::span<const foliage::PreparedPlant> plants,
                                  const ErrorPlan& plan) {
  apps::ProgressBar bar(stderr);
  auto record = error_record(options, plants);
  const auto rows = measure_errors(
      plants, plan, [&](double done) { bar.show("image errors", done); }, &record);
  auto verdicts = judge(rows);
  files::write_whole(options.out / "runs.csv", apps::to_csv<ErrorRow>(rows, error_columns()));
  files::write_whole(options.out / "summary.csv", apps::to_csv<Verdict>(verdicts, verdict_columns()));
  return verdicts;
}

std::string write_popping(const Options& options, std::span<const foliage::PreparedPlant> plants) {
  PopPlan plan;
  plan.error_px = options.error_px;
  plan.mode = mode_of(options);
  if (options.quick) {
    plan.heights = {64};
    plan.range = 1.4;
  }
  const apps::RunFacts facts = apps::run_facts(plan.mode);
  apps::Record<PopRow> record(options.out / "popping.csv", pop_columns(),
                              [&](const PopRow& row) { return same_run(row, facts); });
  apps::ProgressBar bar(stderr);
  const auto progress = [&](double done) { bar.show("popping", done); };
  const auto show = [&](const Popped& popped) {
    const PopRow& row = popped.row;
    write_sheet(options.out / ("popping_" + row.plant + "_" + row.moving + "_" +
                               std::to_string(std::lround(row.height_px)) + ".png"),
                popped.sheet);
  };
  return popping_md(measure_popping(plants, plan, progress, show, &record));
}

std::string columns_md() {
  return "# Columns\n\n## runs.csv: one picture each\n" + apps::explain(error_columns()) +
         "\n## summary.csv: means over the views\n" + apps::explain(verdict_columns()) +
         "\n## popping.csv: faded against unfaded\n" + apps::explain(pop_columns()) +
         "\n## times.csv: two ways timed in turn\n" + explain_times();
}

std::string head_md(const Options& options, std::span<const foliage::PreparedPlant> plants, std::uint64_t dirty) {
  const apps::Machine& machine = apps::this_machine();
  std::string text =
      "# Plants: what they cost and how true they look\n\nmanzana-foliage-benchmark " MANZANA_VERSION ", commit " +
      machine.commit + ", " + apps::now_utc() + ", " + machine.processor + ", " + gl::renderer_name() + ".\n";
  if (options.quick) text += "A quick run: few plants, views, distances and repetitions.\n";
  if (gl::software_renderer())
    text += "GL runs in software here: its times mean nothing by themselves, only their ratios within one row do.\n";
  if (dirty > 0)
    text += std::to_string(dirty) + " timed rows are dirty: other programs had the machine meanwhile (times.csv).\n";
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

void measure_all(const Options& options, std::span<const foliage::PreparedPlant> plants) {
  const ErrorPlan plan = plan_of(options);
  const auto verdicts = write_errors(options, plants, plan);
  const std::string popping = write_popping(options, plants);
  const Times times = options.errors_only ? Times{} : measure_times({options.quick, options.out}, plants);
  files::write_whole(options.out / "columns.md", columns_md());
  auto plots = error_plots(verdicts);
  plots.insert(plots.end(), times.plots.begin(), times.plots.end());
  const auto drawn = apps::draw_all(options.out, plots);
  files::write_whole(options.out / "report.md", head_md(options, plants, times.dirty) + errors_md(verdicts, plan) +
                                                    popping + times.text + plots_md(drawn));
}

std::vector<StepRow> write_steps(const Options& options, std::span<const foliage::PreparedPlant> plants,
                                 const TradePlan& plan) {
  const apps::RunFacts facts = apps::run_facts(plan.errors.mode);
  apps::Record<StepRow> record(options.out / "steps.csv", step_columns(),
                               [&](const StepRow& row) { return same_run(row, facts); });
  apps::ProgressBar bar(stderr);
  return measure_trade_steps(
      plants, plan, [&](double done) { bar.show("steps of an approach", done); }, record);
}

void measure_trade(const Options& options, std::span<const foliage::PreparedPlant> plants) {
  TradePlan plan = trade_plan(options.quick);
  set_asked(options, plan.errors);
  if (options.views) plan.far.views = *options.views;
  if (!options.heights.empty()) plan.step_heights = options.heights;
  auto record = error_record(options, plants,
                             {bark_of(plants, make_stand(plants, plan)), bark_of(plants, make_wood(plants, plan))});
  apps::ProgressBar bar(stderr);
  const auto rows = measure_trade(
      plants, plan, [&](double done) { bar.show("image errors", done); }, record);
  const std::vector<StepRow> steps = write_steps(options, plants, plan);
  const Effort effort{options.quick, options.out};
  const Times times = measure_rows(effort, [&](Times& t) {
    add_trade_costs(effort, plants, plan, t);
    add_zhang(effort, plants, t);
  });
  std::vector<TradePoint> points = trade_points(rows, steps, times);
  const std::vector<Profile> profiles = choose_profiles(points);
  files::write_whole(options.out / "runs.csv", apps::to_csv<ErrorRow>(rows, error_columns()));
  files::write_whole(options.out / "summary.csv", apps::to_csv<TradePoint>(points, trade_columns()));
  files::write_whole(options.out / "quality.csv", quality_csv(profiles));
  files::write_whole(options.out / "columns.md",
                     "# Columns\n\n## runs.csv: one picture each\n" + apps::explain(error_columns()) +
                         "\n## summary.csv and front.csv: means over the views\n" + apps::explain(trade_columns()) +
                         "\n## steps.csv: an approach each\n" + apps::explain(step_columns()) +
                         "\n## times.csv: two ways timed in turn\n" + explain_times());
  const auto drawn = apps::draw_all(options.out, trade_plots(points));
  files::write_whole(options.out / "report.md", head_md(options, plants, times.dirty) +
                                                    trade_md(points, profiles, plan) + times.text + plots_md(drawn));
  std::erase_if(points, [](const TradePoint& p) { return p.front.empty(); });
  files::write_whole(options.out / "front.csv", apps::to_csv<TradePoint>(points, trade_columns()));
}

void measure_plants(const Options& options, std::span<const foliage::PreparedPlant> plants) {
  if (options.trade) return measure_trade(options, plants);
  write_sheets(options, plants);
  if (!options.sheets_only) measure_all(options, plants);
}

std::vector<foliage::PreparedPlant> forest_plants(const Options& options) {
  if (options.quick || !options.plants.empty()) return plants_of(options);
  std::fprintf(stderr, "preparing seven trees of up to 430 000 triangles\n");
  return prepare_source_trees(foliage::PrepareOptions().visibility_side);
}

void measure_forest(const Options& options) {
  const ForestPathPlan plan = forest_path_plan(options.quick);
  Forest forest(forest_plants(options), plan.trees, plan.most_full_quads);
  forest.ground.make_far(forest.plants);
  const apps::RunFacts facts = apps::run_facts(plan.errors.mode);
  apps::Record<ErrorRow> record(options.out / "runs.csv", error_columns(),
                                [&](const ErrorRow& row) { return same_run(row, facts); });
  apps::ProgressBar bar(stderr);
  const auto rows = measure_forest_errors(
      forest.ground, forest.path(plan.stops, plan.height_px), plan.errors,
      [&](double done) { bar.show("image errors", done); }, record,
      [&](const std::string& name, const Picture& sheet) { write_sheet(options.out / (name + ".png"), sheet); });
  const Times times = measure_rows({options.quick, options.out}, [&](Times& t) {
    add_forest_path(forest, plan, t);
    add_from_above(forest.plants, plan, t);
  });
  const auto verdicts = judge(rows);
  files::write_whole(options.out / "runs.csv", apps::to_csv<ErrorRow>(rows, error_columns()));
  files::write_whole(options.out / "summary.csv", apps::to_csv<Verdict>(verdicts, verdict_columns()));
  files::write_whole(options.out / "columns.md", "# Columns\n\n## runs.csv: windows of a frame each\n" +
                                                     apps::explain(error_columns()) + "\n## summary.csv\n" +
                                                     apps::explain(verdict_columns()) + "\n## times.csv: frames\n" +
                                                     explain_times());
  files::write_whole(options.out / "report.md", head_md(options, forest.plants, times.dirty) + times.text +
                                                    forest_errors_md(verdicts, plan.errors));
}

}  // namespace

int run_benchmark(const Options& options) {
  files::make_folder(options.out);
  apps::watch_for_interrupts();
  const gl::HeadlessContext context;
  try {
    if (options.forest)
      measure_forest(options);
    else
      measure_plants(options, plants_of(options));
  } catch (const apps::Interrupted&) {
    std::fprintf(stderr, "interrupted: the same command goes on from what is finished in %s\n", options.out.c_str());
    return 1;
  }
  std::printf("written to %s%s\n", options.out.c_str(), options.sheets_only ? "" : "; read report.md first");
  return 0;
}

}  // namespace manzana::foliage_benchmark

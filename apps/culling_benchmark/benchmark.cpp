#include "apps/culling_benchmark/benchmark.h"

#include <cstdio>

#include "apps/common/child.h"
#include "apps/common/progress_bar.h"
#include "apps/culling_benchmark/cars.h"
#include "apps/culling_benchmark/catalogue.h"
#include "apps/culling_benchmark/extremes.h"
#include "apps/culling_benchmark/frame_table.h"
#include "apps/culling_benchmark/paper_plots.h"
#include "apps/culling_benchmark/paper_section.h"
#include "apps/culling_benchmark/plots.h"
#include "apps/culling_benchmark/report.h"
#include "apps/culling_benchmark/report_growth.h"
#include "apps/culling_benchmark/report_trade.h"
#include "apps/culling_benchmark/rules.h"
#include "apps/culling_benchmark/run.h"
#include "apps/culling_benchmark/semantics.h"
#include "apps/culling_benchmark/sharing.h"
#include "apps/culling_benchmark/summary.h"
#include "files/whole_file.h"

namespace manzana::culling_benchmark {
namespace {

std::string columns_md() {
  return "# Columns\nAn empty cell is a value that was not measured.\n\n"
         "## summary.csv; front.csv has its rows that are best in the trade\n" +
         apps::explain(summary_columns()) + "\n## runs.csv\n" + apps::explain(run_columns()) +
         "\n## frames/CASE_PEER.csv (first process)\n" + apps::explain(frame_columns()) + paper_columns_md() +
         extremes_columns_md() + cars_columns_md() + sharing_columns_md() + semantics_columns_md();
}

/// What ended in the middle of writing a file leaves its part.
void remove_parts(const std::filesystem::path& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension().string().starts_with(".part")) std::filesystem::remove(entry.path());
}

std::vector<apps::Script> all_plots(const Options& options, std::span<const SummaryRow> table, const PaperPart& paper) {
  std::vector<apps::Script> scripts = case_plots(options, table);
  for (const auto& more : {growth_plots(table), trade_plots(table), paper::paper_plots(paper.run)})
    scripts.insert(scripts.end(), more.begin(), more.end());
  return scripts;
}

/// Empty when it is not asked for.
std::string extremes_section(const Options& options, std::vector<std::string>& wrong) {
  if (!with_extremes(options)) return {};
  const double left = besides(options).extremes;
  apps::ProgressBar bar(stderr);
  const Extremes extremes = run_extremes({.seed = options.seed, .cameras = options.quick ? 20 : 100}, [&](double done) {
    apps::throw_if_interrupted();
    bar.show("extremes", done, apps::time_left(left * (1 - done)));
  });
  write_extremes(options.out, extremes);
  for (const std::string& line : extremes_faults(extremes)) wrong.push_back(line);
  return extremes_md(extremes);
}

/// Empty when it is not asked for.
std::string cars_section(const Options& options) {
  if (!with_cars(options)) return {};
  const Besides left = besides(options);
  apps::ProgressBar bar(stderr);
  const CarsRun run = run_cars({.seed = options.seed}, [&](double done) {
    apps::throw_if_interrupted();
    bar.show("cars", done, apps::time_left(left.cars * (1 - done) + left.extremes));
  });
  write_cars(options.out, run);
  return cars_md(run);
}

/// Empty when it is not asked for.
std::string sharing_section(const Options& options) {
  if (!with_growth(options)) return {};
  const Besides left = besides(options);
  apps::ProgressBar bar(stderr);
  const SharingRun run = run_sharing({.seed = options.seed}, [&](double done) {
    apps::throw_if_interrupted();
    bar.show("one query on all threads", done,
             apps::time_left(left.sharing * (1 - done) + left.semantics + left.cars + left.extremes));
  });
  write_sharing(options.out, run);
  return sharing_md(run);
}

/// Empty when it is not asked for.
std::string semantics_section(const Options& options) {
  if (!with_semantics(options)) return {};
  const Besides left = besides(options);
  apps::ProgressBar bar(stderr);
  const SemanticsRun run = run_semantics({.seed = options.seed}, [&](double done) {
    apps::throw_if_interrupted();
    bar.show("classes", done, apps::time_left(left.semantics * (1 - done) + left.cars + left.extremes));
  });
  write_semantics(options.out, run);
  return semantics_md(run);
}

int time_all(const Options& options, const std::vector<std::string>& arguments) {
  for (const std::string& name : cases_of(options)) look_up_case(name);
  files::make_folder(options.out);
  remove_parts(options.out);
  const auto rows = run_all(options, arguments);
  const auto table = summarise(options, rows);
  auto wrong = faults(rows);
  files::write_whole(options.out / "summary.csv", to_csv(table));
  if (const auto front = trade_front(table); !front.empty())
    files::write_whole(options.out / "front.csv", to_csv(front));
  files::write_whole(options.out / "columns.md", columns_md());
  std::filesystem::remove_all(truth_folder(options));
  const PaperPart paper = with_paper(options) ? measure_paper(options, arguments) : PaperPart{};
  std::string sections = sharing_section(options);
  sections += semantics_section(options);
  sections += cars_section(options);
  sections += extremes_section(options, wrong);
  const auto plots = apps::draw_all(options.out, all_plots(options, table, paper));
  files::write_whole(options.out / "report.md",
                     report_md(options, table, wrong, plots) + sections + paper_section(paper, plots));
  std::printf("written to %s; read report.md first\n", options.out.c_str());
  for (const std::string& line : wrong) std::fprintf(stderr, "WRONG: %s\n", line.c_str());
  return wrong.empty() ? 0 : 1;
}

}  // namespace

int run_benchmark(const Options& options, const std::vector<std::string>& arguments) {
  if (options.list) {
    std::fputs(list_text().c_str(), stdout);
    return 0;
  }
  if (options.paper_process) {
    run_paper_process(options);
    return 0;
  }
  if (options.process > 0) {
    run_process(options);
    return 0;
  }
  apps::watch_for_interrupts();
  try {
    return time_all(options, arguments);
  } catch (const apps::Interrupted&) {
    std::fprintf(stderr, "interrupted: the same command goes on from what is finished in %s\n", options.out.c_str());
    return 1;
  }
}

}  // namespace manzana::culling_benchmark

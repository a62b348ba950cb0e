#include "apps/culling_benchmark/run.h"

#include <cstdio>
#include <sstream>

#include "apps/common/child.h"
#include "apps/common/progress_bar.h"
#include "apps/common/record.h"
#include "apps/culling_benchmark/catalogue.h"
#include "apps/culling_benchmark/measure.h"
#include "apps/culling_benchmark/rules.h"

namespace manzana::culling_benchmark {
namespace {

constexpr const char* kRow = "row ";
constexpr const char* kProgress = "at ";  // fraction, seconds left, the stage

/// Every row that the run must have in the end, as far as it is known before.
std::vector<RunRow> expected_rows(const Options& options) {
  std::vector<RunRow> rows;
  const int processes = rules_of(options).processes;
  for (const std::string& name : cases_of(options))
    for (const std::string& slug : peers_for(options, name))
      for (int process = 1; process <= processes && can_measure(name, slug); ++process)
        rows.push_back(expected_row(options, name, slug, process));
  return rows;
}

std::filesystem::path runs_file(const Options& options) { return options.out / "runs.csv"; }

/// Rows of another commit, machine, seed and so on are of no use any more.
bool usable(const RunRow& row, const Options& options) {
  return same_measurement(row, expected_row(options, row.case_name, row.peer, static_cast<int>(row.process)));
}

class Parent {
 public:
  Parent(const Options& options, const std::vector<std::string>& arguments)
      : options_(options),
        arguments_(arguments),
        wanted_(expected_rows(options)),
        record_(runs_file(options), run_columns(), [&](const RunRow& row) { return usable(row, options); }),
        bar_(stderr) {}

  std::vector<RunRow> run() {
    for (int process = 1; process <= rules_of(options_).processes; ++process)
      if (lacks(process)) start(process);
    std::vector<RunRow> result;
    for (const RunRow& wanted : wanted_)
      for (const RunRow& row : record_.rows())
        if (same_measurement(row, wanted)) result.push_back(row);
    return result;
  }

 private:
  bool lacks(int process) const {
    for (const RunRow& wanted : wanted_)
      if (wanted.process == static_cast<std::uint64_t>(process) && !is_finished(record_.rows(), wanted)) return true;
    return false;
  }

  void start(int process) {
    const Besides more = besides(options_);
    seconds_after_ = more.paper + more.sharing + more.semantics + more.cars + more.extremes;
    for (int later = process + 1; later <= rules_of(options_).processes; ++later)
      seconds_after_ += expected_seconds(options_, later, record_.rows());
    std::vector<std::string> command{"/proc/self/exe"};
    command.insert(command.end(), arguments_.begin(), arguments_.end());
    command.insert(command.end(), {"--process", std::to_string(process)});
    const int code = apps::run_child(command, [&](const std::string& line) { hear(line); });
    if (code == 1) throw std::runtime_error("process " + std::to_string(process) + " failed");
    if (code != 0)
      throw std::runtime_error("process " + std::to_string(process) + " ended with " + std::to_string(code));
    if (lacks(process)) throw std::runtime_error("process " + std::to_string(process) + " did not measure all");
  }

  void hear(const std::string& line) {
    if (line.starts_with(kRow)) {
      if (auto row = apps::from_line(std::string_view(line).substr(4), run_columns())) record_.keep(*std::move(row));
    } else if (line.starts_with(kProgress)) {
      std::istringstream in(line.substr(3));
      double fraction = 0, seconds_left = 0;
      std::string stage;
      in >> fraction >> seconds_left >> std::ws;
      std::getline(in, stage);
      bar_.show(stage, fraction, apps::time_left(seconds_left + seconds_after_));
    }
  }

  const Options& options_;
  const std::vector<std::string>& arguments_;
  std::vector<RunRow> wanted_;
  apps::Record<RunRow> record_;
  double seconds_after_ = 0;  // of what follows this process
  apps::ProgressBar bar_;
};

}  // namespace

std::vector<RunRow> run_all(const Options& options, const std::vector<std::string>& arguments) {
  return Parent(options, arguments).run();
}

void run_process(const Options& options) {
  apps::end_with_parent();
  const Tell tell{[](const RunRow& row) {
                    std::printf("%s%s", kRow, apps::to_line(row, run_columns()).c_str());
                    std::fflush(stdout);
                  },
                  [](const std::string& stage, double fraction, double seconds_left) {
                    std::printf("%s%g %g %s\n", kProgress, fraction, seconds_left, stage.c_str());
                    std::fflush(stdout);
                  }};
  auto finished = apps::rows_in(runs_file(options), run_columns());
  std::erase_if(finished, [&](const RunRow& row) { return !usable(row, options); });
  measure(options, finished, tell);
}

}  // namespace manzana::culling_benchmark

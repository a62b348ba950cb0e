#include "apps/culling_benchmark/paper_section.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>

#include "apps/common/child.h"
#include "apps/common/machine.h"
#include "apps/common/progress_bar.h"
#include "apps/culling_benchmark/paper_record.h"
#include "apps/culling_benchmark/paper_text.h"
#include "apps/culling_benchmark/rules.h"
#include "files/whole_file.h"
#include "gl/context.h"

namespace manzana::culling_benchmark {
namespace {

constexpr const char* kRecord = "paper_frames.csv";

/// Six parts: the range of six ratios holds the true median with 96.9 %, whatever their distribution.
paper::PaperOptions paper_options(const Options& options) {
  constexpr int kParts = 6, kQuickFrames = 36, kFrames = 72;
  paper::PaperOptions chosen;
  chosen.frames = options.frames.value_or(options.quick ? kQuickFrames : kFrames);
  chosen.parts = std::min(kParts, chosen.frames);
  chosen.seed = options.seed;
  chosen.budget_s = besides(options).paper;
  return chosen;
}

std::string made_by() { return apps::this_machine().commit + ", " + apps::short_name(apps::this_machine()); }

std::string read_record(const Options& options) {
  std::ifstream in(options.out / kRecord, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Empty, or why it could not.
std::string draw_in_child(const Options& options, const std::vector<std::string>& arguments) {
  std::vector<std::string> command{"/proc/self/exe"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  command.emplace_back("--paper-process");
  apps::ProgressBar bar(stderr);
  std::string why;
  const int code = apps::run_child(command, [&](const std::string& line) {
    if (line.starts_with("at ")) {
      const double done = std::stod(line.substr(3));
      const Besides left = besides(options);
      bar.show("Pina 2009", done,
               apps::time_left(left.paper * (1 - done) + left.sharing + left.semantics + left.cars + left.extremes));
    }
    if (line.starts_with("cannot ")) why = line.substr(7);
  });
  if (code == 0) return why;
  throw std::runtime_error("the process that draws ended with " + std::to_string(code));
}

}  // namespace

void run_paper_process(const Options& options) {
  apps::end_with_parent();
  std::unique_ptr<gl::HeadlessContext> context;
  try {
    context = std::make_unique<gl::HeadlessContext>();
  } catch (const std::runtime_error& none) {
    std::printf("cannot %s\n", none.what());
    return;
  }
  paper::PaperRun run = paper::unmeasured(paper::paper_lanes(), paper_options(options));
  run.renderer = gl::renderer_name();
  paper::restore(run, read_record(options), made_by());
  const auto say = [](double done) {
    std::printf("at %g\n", done);
    std::fflush(stdout);
  };
  paper::measure(run, {say, [&](const paper::PaperRun& part) {
                         files::write_whole(options.out / kRecord, paper::record(part, made_by()));
                       }});
}

PaperPart measure_paper(const Options& options, const std::vector<std::string>& arguments) {
  PaperPart part;
  part.why_not = draw_in_child(options, arguments);
  if (!part.why_not.empty()) return part;
  part.run = paper::unmeasured(paper::paper_lanes(), paper_options(options));
  paper::restore(part.run, read_record(options), made_by());
  part.rows = paper::paper_rows(part.run);
  files::write_whole(options.out / "paper.csv", paper::to_csv(part.rows));
  return part;
}

std::string paper_section(const PaperPart& part, std::span<const std::string> plots) {
  if (!part.why_not.empty()) return "## Pina 2009\nNot drawn here: " + part.why_not + ".\n";
  if (part.run.lanes.empty()) return "";
  const paper::PaperOptions& o = part.run.options;
  return paper::paper_text(part.run, part.rows, paper::count_grains(o.frames, o.seed), plots);
}

std::string paper_columns_md() {
  return "\n## paper.csv\n" + apps::explain(paper::paper_columns()) + "\n## paper_frames.csv\n" +
         apps::explain(paper::frame_columns());
}

}  // namespace manzana::culling_benchmark

#include "apps/culling_benchmark/rules.h"

#include "apps/culling_benchmark/catalogue.h"

namespace manzana::culling_benchmark {
namespace {

constexpr double kQuickSeconds = 40;  // the report takes the rest of the minute

bool is_million(const std::string& name) { return name.starts_with("1M"); }

/// What to measure is left to the program.
bool says_nothing(const Options& options) {
  return options.cases.empty() && !options.growth && !options.trade && !options.paper && !options.extremes &&
         !options.cars && !options.semantics;
}

/// What a case gets of a process, seconds: enough for six processes in less than half an hour. Cold cases are slow
/// because of the stream, the largest because of what is built and checked.
double full_seconds(const std::string& name) {
  const CaseInfo info = case_info(name);
  if (name.starts_with("grow-10M")) return 14;
  if (info.family == Family::growth) return info.cold ? 8 : 2;
  if (info.family == Family::trade) return 6;
  if (info.family == Family::file) return 20;
  if (info.cold || name == "1M") return 30;
  return name.starts_with("C") || name == "10k" ? 3 : 10;
}

}  // namespace

Rules rules_of(const Options& options) {
  if (options.quick) return {"quick", 1, {.least_seconds = 0.05, .pairs = 15, .least_pairs = 9, .least_frames = 5}};
  return {"full", kProcesses, {.least_seconds = 0.5, .pairs = 50, .least_pairs = 9, .least_frames = 12}};
}

double case_seconds(const Options& options, const std::string& case_name) {
  if (!options.quick) return full_seconds(case_name);
  double all = 0;
  for (const std::string& name : cases_of(options)) all += full_seconds(name);
  return kQuickSeconds * full_seconds(case_name) / all;
}

std::filesystem::path truth_folder(const Options& options) { return options.out / "truth"; }

std::vector<std::string> cases_of(const Options& options) {
  std::vector<std::string> all = options.cases;
  const auto add = [&](const std::vector<std::string>& more) { all.insert(all.end(), more.begin(), more.end()); };
  const bool unsaid = says_nothing(options);
  if (unsaid)
    add(options.quick ? std::vector<std::string>{"C2", "10k", "100k", "100k-cold", "1M-1km"} : names_of(Family::speed));
  if (with_growth(options)) add(names_of(Family::growth));
  if (options.trade || (unsaid && !options.quick)) add(names_of(Family::trade));
  return all;
}

bool with_growth(const Options& options) { return options.growth || (says_nothing(options) && !options.quick); }

bool with_extremes(const Options& options) { return options.extremes || (says_nothing(options) && !options.quick); }

bool with_cars(const Options& options) { return options.cars || (says_nothing(options) && !options.quick); }

bool with_semantics(const Options& options) { return options.semantics || (says_nothing(options) && !options.quick); }

bool with_paper(const Options& options) { return options.paper || (says_nothing(options) && !options.quick); }

Besides besides(const Options& options) {
  const double paper = options.quick ? 50 : 450;
  return {.paper = with_paper(options) ? paper : 0.0,
          .sharing = with_growth(options) ? 40.0 : 0.0,
          .semantics = with_semantics(options) ? 20.0 : 0.0,
          .cars = with_cars(options) ? 40.0 : 0.0,
          .extremes = with_extremes(options) ? 20.0 : 0.0};
}

int frames_of(const Options& options, const std::string& case_name) {
  if (options.frames) return *options.frames;
  if (case_info(case_name).family == Family::growth) return 60;
  return options.quick && is_million(case_name) ? 100 : 300;
}

}  // namespace manzana::culling_benchmark

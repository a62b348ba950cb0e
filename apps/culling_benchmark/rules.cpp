#include "apps/culling_benchmark/rules.h"

#include "apps/culling_benchmark/catalogue.h"

namespace manzana::culling_benchmark {
namespace {

constexpr double kQuickSeconds = 50;  // the report takes the rest of the minute

bool is_million(const std::string& name) { return name.starts_with("1M"); }

/// What to measure is left to the program.
bool says_nothing(const Options& options) {
  return options.cases.empty() && !options.growth && !options.trade && !options.paper && !options.extremes &&
         !options.cars;
}

}  // namespace

Rules rules_of(const Options& options) {
  if (options.quick) return {"quick", 1, kQuickSeconds, {.pairs = 15, .least_pairs = 9, .least_frames = 5}};
  return {"full", kProcesses, 0, {.pairs = 50, .least_pairs = 9, .least_frames = 12}};
}

double row_seconds(const std::string& case_name) {
  const CaseInfo info = case_info(case_name);
  const double warm = info.family == Family::growth ? 1 : 2;
  return info.cold ? 4 * warm : warm;
}

std::vector<std::string> cases_of(const Options& options) {
  std::vector<std::string> all = options.cases;
  const auto add = [&](const std::vector<std::string>& more) { all.insert(all.end(), more.begin(), more.end()); };
  const bool unsaid = says_nothing(options);
  if (unsaid)
    add(options.quick ? std::vector<std::string>{"C2", "10k", "100k", "100k-cold", "1M-1km"} : names_of(Family::speed));
  if (options.growth || (unsaid && !options.quick)) add(names_of(Family::growth));
  if (options.trade || (unsaid && !options.quick)) add(names_of(Family::trade));
  return all;
}

bool with_extremes(const Options& options) { return options.extremes || (says_nothing(options) && !options.quick); }

bool with_cars(const Options& options) { return options.cars || (says_nothing(options) && !options.quick); }

bool with_paper(const Options& options) { return options.paper || (says_nothing(options) && !options.quick); }

int frames_of(const Options& options, const std::string& case_name) {
  if (options.frames) return *options.frames;
  if (case_info(case_name).family == Family::growth) return 60;
  return options.quick && is_million(case_name) ? 100 : 300;
}

double share_of(const std::string& case_name) {
  const CaseInfo info = case_info(case_name);
  if (info.cold) return 4;
  if (is_million(case_name)) return 8;
  return info.family == Family::file || case_name.starts_with("100k") ? 2 : 1;
}

}  // namespace manzana::culling_benchmark

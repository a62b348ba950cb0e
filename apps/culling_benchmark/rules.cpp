#include "apps/culling_benchmark/rules.h"

#include "culling/baselines/cases.h"

namespace manzana::culling_benchmark {
namespace {

constexpr double kQuickSeconds = 52;  // the report takes the rest of the minute

bool is_million(const std::string& name) { return name.starts_with("1M") && baselines::find_case(name) != nullptr; }

}  // namespace

Rules rules_of(const Options& options) {
  if (options.quick) return {"quick", 1, kQuickSeconds, {.pairs = 15, .least_pairs = 9, .least_frames = 5}, 0};
  return {"full", kProcesses, 0, {.seconds = 2, .pairs = 50, .least_pairs = 9, .least_frames = 12}, 8};
}

std::vector<std::string> cases_of(const Options& options) {
  if (!options.cases.empty()) return options.cases;
  if (options.quick) return {"C2", "10k", "100k", "100k-cold", "1M-1km"};
  std::vector<std::string> all;
  for (const baselines::Case& c : baselines::cases()) all.emplace_back(c.name);
  return all;
}

int frames_of(const Options& options, const std::string& case_name) {
  if (options.frames) return *options.frames;
  return options.quick && is_million(case_name) ? 100 : 300;
}

double share_of(const std::string& case_name) {
  const baselines::Case* generated = baselines::find_case(case_name);
  if (generated != nullptr && generated->cold) return 3;
  if (is_million(case_name)) return 5;
  return generated == nullptr || case_name.starts_with("100k") ? 2 : 1;
}

}  // namespace manzana::culling_benchmark

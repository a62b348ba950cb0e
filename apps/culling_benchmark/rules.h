#pragma once
/// How much is measured: quickly, or by the rules for what is to be believed.
#include "apps/culling_benchmark/options.h"
#include "apps/culling_benchmark/timing.h"

namespace manzana::culling_benchmark {

/// Six, because the range of six process medians holds the true one with 96.9 %, whatever their distribution.
inline constexpr int kProcesses = 6;
inline constexpr int kAttempts = 4;  ///< the first, and up to three more when the machine was disturbed

struct Rules {
  std::string mode;  ///< quick or full
  int processes = kProcesses;
  double seconds = 0;  ///< a process may take that long; 0: as long as it needs
  Limits limits;       ///< of one row; `seconds` are those of row_seconds, or what is left
};
Rules rules_of(const Options& options);
/// Of a case when there is no hurry.
double row_seconds(const std::string& case_name);

std::vector<std::string> cases_of(const Options& options);
bool with_extremes(const Options& options);
bool with_cars(const Options& options);
/// Whether the experiments of Pina 2009 are drawn.
bool with_paper(const Options& options);
int frames_of(const Options& options, const std::string& case_name);

/// Of the time of a quick run that a case gets, in parts.
double share_of(const std::string& case_name);

}  // namespace manzana::culling_benchmark

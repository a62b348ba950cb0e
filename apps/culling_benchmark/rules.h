#pragma once
/// How much is measured: quickly, or by the rules for what is to be believed.
#include <filesystem>

#include "apps/culling_benchmark/options.h"
#include "apps/culling_benchmark/timing.h"

namespace manzana::culling_benchmark {

/// Six, because the range of six process medians holds the true one with 96.9 %, whatever their distribution.
inline constexpr int kProcesses = 6;

struct Rules {
  std::string mode;  ///< quick or full
  int processes = kProcesses;
  Limits limits;  ///< of one row; its seconds are what case_seconds leaves
};
Rules rules_of(const Options& options);
/// What a case is given in each process, with all that it needs; what it leaves goes to the next ones. A quick run
/// shares what there is over its cases.
double case_seconds(const Options& options, const std::string& case_name);

/// Where the processes of a run leave the truth for each other; gone when all is measured.
std::filesystem::path truth_folder(const Options& options);

std::vector<std::string> cases_of(const Options& options);
/// The growing cities, and one query on all threads.
bool with_growth(const Options& options);
bool with_extremes(const Options& options);
bool with_cars(const Options& options);
bool with_semantics(const Options& options);
/// Whether the experiments of Pina 2009 are drawn.
bool with_paper(const Options& options);

/// The parts that follow the cases, in their order, and what each may take, seconds; 0: not wanted.
struct Besides {
  double paper = 0, sharing = 0, semantics = 0, cars = 0, extremes = 0;
};
Besides besides(const Options& options);

int frames_of(const Options& options, const std::string& case_name);

}  // namespace manzana::culling_benchmark

#pragma once
/// One query on one thread and on all, where it visits much (culling/cull_parallel.h).
///   const SharingRun run = run_sharing({}, [](double done) { ... });
///   report += sharing_md(run);
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "apps/culling_benchmark/growth.h"
#include "culling/cull_parallel.h"

namespace manzana::culling_benchmark {

/// A view of which much is visited, or of which little is.
struct SharingView {
  std::string what;
  culling::View view;
  culling::CullOptions options;
};
std::vector<SharingView> sharing_views(const Growth& growth, const baselines::City& city);
/// A class a kind of object, its bit.
culling::BqrTree tree_with_classes(const baselines::City& city);

struct SharingOptions {
  std::uint64_t seed = 1;
  std::vector<std::string> cases{"grow-100k-all", "grow-1M-all", "grow-10M-all"};  ///< of growth.h
  int rounds = 41;
  double rest_ms = 5;  ///< between queries, as in a frame: other threads fall asleep
};
/// Medians over the rounds, with a 95 % interval for the ratio.
struct SharingRow {
  std::uint64_t objects = 0;
  std::string view;
  std::uint64_t nodes = 0, shared = 0;  ///< visited; whether other threads were asked
  double one_us = 0, all_us = 0, ratio = 0, ratio_lo = 0, ratio_hi = 0;
};
struct SharingRun {
  SharingOptions options;
  std::vector<SharingRow> rows;
};
SharingRun run_sharing(const SharingOptions& options, const std::function<void(double)>& progress);

/// Throws std::runtime_error when the file cannot be written.
void write_sharing(const std::filesystem::path& folder, const SharingRun& run);
std::string sharing_md(const SharingRun& run);
std::string sharing_columns_md();

}  // namespace manzana::culling_benchmark

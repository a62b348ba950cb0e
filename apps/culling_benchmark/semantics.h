#pragma once
/// What is asked of a class alone: filtered in the tree's traversal, by classes united upward, and filtered after it.
///   const SemanticsRun run = run_semantics({}, [](double done) { ... });
///   report += semantics_md(run);
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "culling/baselines/city.h"
#include "culling/cull.h"

namespace manzana::culling_benchmark {

/// As scenegraph/classes.h has them, by kind and height.
std::vector<culling::ClassMask> classes_of(const baselines::City& city);

/// What of an answer about everything is of these classes: runs, neighbours joined.
void filter_after(const culling::BqrTree& tree, const culling::Answer& all, culling::ClassMask classes,
                  std::vector<culling::ObjectRun>& out);

struct SemanticsOptions {
  std::uint64_t seed = 1;
  std::vector<std::uint32_t> cities{10'000, 100'000, 1'000'000};  ///< objects
  int frames = 60, rounds = 31;
};
/// Medians over the rounds of the medians over a flight's frames, with 95 % intervals for the ratios.
struct SemanticsRow {
  std::uint64_t objects = 0;
  std::string asked;
  double share = 0;  ///< of the city's objects that are of these classes
  double in_nodes = 0, after_nodes = 0, in_packets = 0, after_packets = 0;  ///< a frame
  double in_us = 0, after_us = 0, ratio = 0, ratio_lo = 0, ratio_hi = 0;    ///< in the traversal / after it
};
struct SemanticsRun {
  SemanticsOptions options;
  std::vector<SemanticsRow> rows;  ///< the first of each city: all classes, of a tree that has them / that has none
};
SemanticsRun run_semantics(const SemanticsOptions& options, const std::function<void(double)>& progress);

/// Throws std::runtime_error when the file cannot be written.
void write_semantics(const std::filesystem::path& folder, const SemanticsRun& run);
std::string semantics_md(const SemanticsRun& run);
std::string semantics_columns_md();

}  // namespace manzana::culling_benchmark

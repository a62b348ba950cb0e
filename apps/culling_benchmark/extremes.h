#pragma once
/// Where culling goes wrong, and whose: objects that are missed or falsely kept, by place, depths, field of view and
/// precision, for the BqR-Tree and for the ways of culling that are found in the field (culling/baselines/naive.h).
///   const Extremes extremes = run_extremes({}, [](double done) { ... });
///   write_extremes(folder, extremes);                    // extremes.csv, extremes_far.csv, extremes.svg
///   report += extremes_md(extremes);
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace manzana::culling_benchmark {

struct ExtremesOptions {
  std::uint64_t seed = 1;
  int cameras = 100;  ///< of each place, depths and field of view
  int objects = 100;  ///< of each sort, a camera
};

/// One way, at one place, through one kind of camera.
struct ExtremesRow {
  std::string place;
  double near_m = 0, far_m = 0, fovy_deg = 0;
  std::string way, precision;
  /// "any": boxes of 10 to 160 m, evenly spread over the view and a little round it, up to 1000 km away; "touching":
  /// boxes that reach 1e-9 to 1e-1 m into the view, at a face, an edge or a corner of it.
  std::string objects;
  std::uint64_t asked = 0, seen = 0, missed = 0, falsely_kept = 0;
  double deepest_missed_m = 0;  ///< how far the missed object that is deepest in view would have to move to leave it
};

/// Where the far plane lies that a way culls with.
struct FarRow {
  std::string place;
  double near_m = 0, far_m = 0;
  std::string way, precision;
  std::uint64_t cameras = 0, without = 0;  ///< without: no plane, or its normal is nothing
  double inward_m = 0, outward_m = 0;      ///< off by at most that much, to the eye and away from it
};

struct Extremes {
  ExtremesOptions options;
  std::vector<ExtremesRow> rows;
  std::vector<FarRow> far;
};

/// On all cores; the same answer on any number of them. `progress`: the fraction done, from any thread but one at a
/// time; what it throws ends the run.
Extremes run_extremes(const ExtremesOptions& options, const std::function<void(double)>& progress);

/// Throws std::runtime_error when a file cannot be written.
void write_extremes(const std::filesystem::path& folder, const Extremes& extremes);

/// Nothing, or the line that says how many objects the tree missed.
std::vector<std::string> extremes_faults(const Extremes& extremes);

/// A section of report.md.
std::string extremes_md(const Extremes& extremes);

/// What stands in the columns, for columns.md.
std::string extremes_columns_md();

}  // namespace manzana::culling_benchmark

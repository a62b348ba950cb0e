#pragma once
/// What plants cost: the sources' own tables, one function each, and forests.
#include <functional>
#include <optional>
#include <string>

#include "apps/common/csv.h"
#include "apps/common/gnuplot.h"
#include "apps/foliage_benchmark/pair_times.h"
#include "apps/foliage_benchmark/stage.h"

namespace manzana::foliage_benchmark {

/// One way against a reference. What was not measured is empty.
struct TimeRow {
  std::string table = {}, plant = {}, way = {}, reference = {};
  std::uint64_t trees = 1;
  std::optional<std::uint64_t> primitives = {}, reference_primitives = {};
  std::optional<double> ms = {}, reference_ms = {};
  std::optional<double> ratio = {}, ratio_lo = {}, ratio_hi = {};  ///< how many times as fast as the reference
  std::optional<std::uint64_t> pairs = {};
  std::optional<double> covered_px = {}, cover = {}, ssim = {}, gmsd = {};
  std::optional<double> source_value = {};  ///< what stands in the source's table
};
std::span<const apps::Column<TimeRow>> time_columns();
void set_times(const PairTimes& times, TimeRow& row);

struct Times {
  std::vector<TimeRow> rows;
  std::string text;  ///< sections of report.md
  std::vector<apps::Script> plots;
};

/// How long each measurement may take.
struct Effort {
  bool quick = false;
  double seconds() const { return quick ? 0.2 : 5; }
  int screen_height() const { return quick ? 360 : 720; }  ///< 16 : 9
};

void add_gumbau(const Effort& effort, Times& times);
void add_deussen(const Effort& effort, std::span<const foliage::PreparedPlant> plants, Times& times);
void add_gadbem(const Effort& effort, std::span<const foliage::PreparedPlant> plants, Times& times);
void add_forests(const Effort& effort, std::span<const foliage::PreparedPlant> plants, Times& times);

/// All of these, with a progress bar.
Times measure_times(bool quick, std::span<const foliage::PreparedPlant> plants);

}  // namespace manzana::foliage_benchmark

#pragma once
/// What plants cost: the sources' own tables, one function each, and forests.
///   times.add({.table = kTable, .plant = plant.name, .way = "points"}, [&](TimeRow& row) { ...measure into row... });
/// A function names its rows first, and measures only when it is asked to: so all rows are known before the first is
/// measured, and what an interrupted run has left is not measured again.
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "apps/common/gnuplot.h"
#include "apps/foliage_benchmark/image_error.h"
#include "apps/foliage_benchmark/lazy.h"
#include "apps/foliage_benchmark/pair_times.h"
#include "apps/foliage_benchmark/stage.h"

namespace manzana::foliage_benchmark {

/// One way against a reference. What was not measured is empty.
struct TimeRow {
  std::string table = {}, plant = {}, way = {}, reference = {};
  std::uint64_t trees = 1;
  std::optional<double> error_px = {};  ///< that was tolerated
  std::optional<std::uint64_t> primitives = {}, reference_primitives = {};
  std::optional<std::uint64_t> bark = {}, leaves = {}, lines = {}, points = {};  ///< quads, quads, ribbons, points
  std::optional<double> ms = {}, ms_99 = {}, reference_ms = {};
  std::optional<double> ratio = {}, ratio_lo = {}, ratio_hi = {};  ///< how many times as fast as the reference
  std::optional<std::uint64_t> pairs = {};
  std::optional<double> overdraw = {};  ///< samples drawn, hidden or not, over those covered
  std::optional<double> covered_px = {}, cover = {}, colour = {}, ssim = {}, gmsd = {};
  std::optional<double> bytes = {};         ///< of memory
  std::optional<double> source_value = {};  ///< what stands in the source's table
};
void set_times(const PairTimes& times, TimeRow& row);
void set_shown(const foliage::Shown& shown, TimeRow& row);
void set_errors(const ImageError& error, TimeRow& row);

struct Times {
  using Measure = std::function<void(TimeRow&)>;
  std::vector<TimeRow> rows;
  std::string text;  ///< sections of report.md
  std::vector<apps::Script> plots;
  std::uint64_t dirty = 0;  ///< rows in whose every attempt the machine was disturbed

  /// Known by table, plant, way and reference.
  void add(TimeRow row, const Measure& measure) {
    take(row, measure);
    rows.push_back(std::move(row));
  }
  /// Pictures, when it is their turn.
  std::function<void(const std::function<void()>&)> draw = [](const std::function<void()>& work) { work(); };
  std::function<void(TimeRow&, const Measure&)> take = [](TimeRow& row, const Measure& measure) { measure(row); };
};

/// How long each measurement may take, and where pictures go.
struct Effort {
  bool quick = false;
  std::filesystem::path out = {};
  double seconds() const { return quick ? 0.1 : 5; }
  int screen_height() const { return quick ? 360 : 720; }  ///< 16 : 9
};

void add_gumbau(const Effort& effort, std::span<const foliage::PreparedPlant> plants, Times& times);
void add_deussen(const Effort& effort, std::span<const foliage::PreparedPlant> plants, Times& times);
void add_gadbem(const Effort& effort, std::span<const foliage::PreparedPlant> plants, Times& times);
void add_forests(const Effort& effort, std::span<const foliage::PreparedPlant> plants, Times& times);
void add_extraction(const Effort& effort, std::span<const foliage::PreparedPlant> plants, Times& times);

void add_zhang(const Effort& effort, std::span<const foliage::PreparedPlant> plants, Times& times);

/// What `add` adds, which it does twice: once to be counted. OUT/times.csv is whole after each row.
Times measure_rows(const Effort& effort, const std::function<void(Times&)>& add);
/// All of these, with a progress bar.
Times measure_times(const Effort& effort, std::span<const foliage::PreparedPlant> plants);

/// The table of times.csv's columns, in Markdown.
std::string explain_times();

}  // namespace manzana::foliage_benchmark

#pragma once
/// paper.csv: each figure of Pina 2009 that was measured again, with the paper's beside it.
///   const std::vector<PaperRow> rows = paper_rows(run);        // run: of paper.h
/// Ratios are what must agree: 2009's milliseconds were those of a GeForce 6800.
#include <span>

#include "apps/common/csv.h"
#include "apps/culling_benchmark/paper.h"

namespace manzana::paper {

struct PaperRow {
  std::string paper_table;  ///< 1, 2, 3; 8 and 9 are figures, text is the end of section 4.2
  std::string paper_row, quantity;
  std::string case_name, peer, residency, attach, car_levels, ratio_to;
  std::uint64_t cars = 0, frames = 0, parts = 0, dirty = 0;
  double value = 0;
  std::optional<double> reference, ratio, ratio_lo, ratio_hi, paper_value, paper_ratio, query_ms, submit_ms, draw_ms;
};

std::span<const apps::Column<PaperRow>> paper_columns();
std::string to_csv(std::span<const PaperRow> rows);

/// In the order of the paper. What was not measured has no row.
std::vector<PaperRow> paper_rows(const PaperRun& run);

/// What the tables call a structure.
std::string title_of(const std::string& peer);

/// A lane of a run, by all that tells it from others; nullptr: not measured.
struct LaneKey {
  std::string city, peer;
  std::size_t levels = 0;  ///< of the cars; 0: no streets
  std::uint32_t cars = 0;
  Residency residency = Residency::resent;
  Attach attach = Attach::lazy;
};
const LaneCosts* find_lane(const PaperRun& run, const LaneKey& key);
/// Triangles of all of a city; 0: not measured.
std::uint64_t city_triangles(const PaperRun& run, const std::string& city);

/// Parts during which other programs had the machine.
std::size_t dirty_parts(const PaperRun& run);

using Quantity = double (*)(const FrameCost&);
/// Over the frames that were measured.
double mean(const LaneCosts& lane, Quantity quantity);
inline double frame_ms(const FrameCost& frame) { return frame.total_ms(); }
inline double query_ms(const FrameCost& frame) { return frame.query_ms; }
inline double submit_ms(const FrameCost& frame) { return frame.submit_ms; }
inline double draw_ms(const FrameCost& frame) { return frame.draw_ms; }
inline double triangle_count(const FrameCost& frame) { return static_cast<double>(frame.triangles); }

}  // namespace manzana::paper

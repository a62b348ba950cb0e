#pragma once
/// paper_frames.csv: what each frame of each lane took, the record from which all about Pina 2009 is made, and from
/// which a run goes on after an interrupt.
///   PaperRun run = unmeasured(lanes, options);
///   restore(run, text, made_by);            // what was measured alike
///   std::string text = record(run, made_by);
#include <span>

#include "apps/common/csv.h"
#include "apps/culling_benchmark/paper.h"

namespace manzana::paper {

struct FrameRow {
  std::string made_by, renderer;
  std::uint64_t seed = 0, frames = 0, parts = 0, width = 0, height = 0;
  std::string case_name, peer, residency, attach, car_levels;
  std::uint64_t cars = 0, city_triangles = 0, frame = 0;
  double query_ms = 0, submit_ms = 0, draw_ms = 0;
  std::uint64_t triangles = 0, dirty = 0;
};
std::span<const apps::Column<FrameRow>> frame_columns();

/// made_by: what else must be equal for frames to stand for ones that would be measured now: commit, machine.
std::string record(const PaperRun& run, const std::string& made_by);
/// Fills frames and parts_done; the renderer too, with the record's first, where it is empty. Lines of other runs are
/// passed over.
void restore(PaperRun& run, std::string_view text, const std::string& made_by);

/// As the tables and the files have them.
std::string text_of(Residency residency);
std::string text_of(Attach attach);
std::string text_of(std::span<const CarLevel> levels);

}  // namespace manzana::paper

#pragma once
/// The experiments of Pina 2009, section 4, on generated cities: what a frame costs with each structure.
///   gl::HeadlessContext context;
///   PaperRun run = unmeasured(paper_lanes(), {.frames = 60, .parts = 3});
///   measure(run, {.progress = [](double done) { ... }});
///   std::vector<PaperRow> rows = paper_rows(run);                    // paper_rows.h, paper_text.h, paper_plots.h
/// The flight's frames are dealt into parts: part p has the frames p, p + parts, p + 2 parts, ... So each part sees all
/// of the flight, and the parts' ratios say how sure a ratio is. All lanes draw a frame one after the other, in an
/// order that chance decides anew for each frame.
#include <functional>
#include <limits>
#include <string>

#include "apps/culling_benchmark/paper_cars.h"
#include "apps/culling_benchmark/paper_stage.h"

namespace manzana::paper {

struct PaperOptions {
  int frames = 300, parts = 6;  ///< parts: at most as many as frames
  int width = 640, height = 360;
  std::uint64_t seed = 1;
  /// No part is begun that would, by the longest one so far, end after that time. The first one always is.
  double budget_s = std::numeric_limits<double>::infinity();
};

/// Where frame i of so many is on the flight, in [0, 1]; a single frame is in the middle.
inline double flight_at(int i, int frames) { return frames > 1 ? static_cast<double>(i) / (frames - 1) : 0.5; }

/// One of the things that are compared: what is drawn, by which structure, and how it gets to the device.
struct Lane {
  std::string city = {};  ///< C1 ... C6
  std::string peer = {};  ///< slug
  Residency residency = Residency::resent;
  std::span<const CarLevel> levels = {};  ///< of the cars; empty: no streets either, the city as it is
  std::uint32_t cars = 0;
  Attach attach = Attach::lazy;
};

/// Wall clock, milliseconds. query: the structure's answer, and the cars on its blocks with their levels; submit: from
/// the first GL call to the return of the last, copies of geometry included; draw: from there to the return of
/// glFinish. A software renderer transforms vertices within `submit`.
struct FrameCost {
  bool measured = false;
  double query_ms = 0, submit_ms = 0, draw_ms = 0;
  std::uint64_t triangles = 0;  ///< submitted; of the city and the cars
  bool dirty = false;           ///< other programs had the machine while its part was measured
  double total_ms() const { return query_ms + submit_ms + draw_ms; }
};

struct LaneCosts {
  Lane lane;
  std::uint64_t city_triangles = 0;
  std::vector<FrameCost> frames;  ///< a row a frame of the flight
};

struct PaperRun {
  PaperOptions options;
  std::string renderer;  ///< of the context that was current
  int parts_done = 0;
  std::vector<LaneCosts> lanes;
};

/// All of the paper's tables and figures. Structures that are not available here are left out.
std::vector<Lane> paper_lanes();

PaperRun unmeasured(const std::vector<Lane>& lanes, const PaperOptions& options);

/// Called as the work goes on.
struct Tell {
  std::function<void(double)> progress = [](double) {};                ///< the fraction that is done
  std::function<void(const PaperRun&)> part = [](const PaperRun&) {};  ///< when one more part is measured
};
/// Measures the parts that are not done. A context must be current, of run.renderer. Takes some 2 GB of memory.
void measure(PaperRun& run, const Tell& tell);

}  // namespace manzana::paper

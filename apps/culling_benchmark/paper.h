#pragma once
/// The experiments of Pina 2009, section 4, on generated cities: what a frame costs with each structure.
///   gl::HeadlessContext context;
///   PaperRun run = run_paper({.frames = 60, .parts = 3}, [](std::string_view what, double done) { ... });
///   // paper_report.h makes tables, plots and text of it
/// The flight's frames are dealt into parts: part p has the frames p, p + parts, p + 2 parts, ... So each part sees all
/// of the flight, and the parts' ratios say how sure a ratio is. In a part all lanes of a job draw a frame one after
/// the other, in an order that chance decides anew for each frame.
#include <functional>
#include <limits>
#include <string>

#include "apps/culling_benchmark/paper_cars.h"
#include "apps/culling_benchmark/paper_stage.h"

namespace manzana::paper {

struct PaperOptions {
  int frames = 300, parts = 6;
  int width = 640, height = 360;
  std::uint64_t seed = 1;
  /// No part is begun that would, by the longest one so far, end after that time. The first one always is.
  double budget_s = std::numeric_limits<double>::infinity();
};

/// One of the things that are compared: a structure, and how geometry gets to the device.
struct Lane {
  std::string peer;  ///< slug
  Residency residency = Residency::resent;
  Attach attach = Attach::lazy;
};

/// What is drawn, and by whom.
struct Job {
  std::string city;                  ///< C1 ... C6
  std::span<const CarLevel> levels;  ///< empty: no streets either, the city as it is
  std::uint32_t cars = 0;
  std::vector<Lane> lanes;
};

/// Wall clock, milliseconds. query: the structure's answer, and the cars on its blocks with their levels; submit: from
/// the first GL call to the return of the last, copies of geometry included; draw: from there to the return of
/// glFinish. A software renderer transforms vertices within `submit`.
struct FrameCost {
  bool measured = false;
  double query_ms = 0, submit_ms = 0, draw_ms = 0;
  std::uint64_t triangles = 0;  ///< submitted; of the city and the cars
  double total_ms() const { return query_ms + submit_ms + draw_ms; }
};

struct LaneCosts {
  Lane lane;
  std::vector<FrameCost> frames;  ///< a row a frame of the flight
};

struct JobCosts {
  Job job;
  std::uint64_t triangles = 0;  ///< of the city
  std::vector<LaneCosts> lanes;
};

struct PaperRun {
  PaperOptions options;
  std::string renderer;
  int parts_done = 0;
  std::vector<JobCosts> jobs;
};

/// All of the paper's tables and figures. Lanes of structures that are not available here are left out.
std::vector<Job> paper_jobs();

using Progress = std::function<void(std::string_view what, double done)>;
/// A context must be current.
PaperRun run_paper(const PaperOptions& options, const Progress& progress);
PaperRun run_jobs(std::vector<Job> jobs, const PaperOptions& options, const Progress& progress);

}  // namespace manzana::paper

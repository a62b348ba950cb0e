#include "apps/culling_benchmark/paper.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <numeric>
#include <thread>

#include "apps/common/conditions.h"
#include "apps/culling_benchmark/paper_lanes.h"
#include "culling/hash.h"
#include "gl/context.h"

namespace manzana::paper {
namespace {

using Clock = std::chrono::steady_clock;
using Peers = std::initializer_list<const char*>;
using Ways = std::initializer_list<Residency>;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

bool available(const std::string& peer) {
  const auto* info = baselines::find_peer(peer);
  return info != nullptr && info->available;
}

/// `like` with each of these structures and ways.
void add_lanes(std::vector<Lane>& lanes, Lane like, Peers peers, Ways ways) {
  for (const Residency way : ways)
    for (const char* peer : peers) {
      like.peer = peer;
      like.residency = way;
      if (available(like.peer)) lanes.push_back(like);
    }
}

/// Lane numbers in an order that is the frame's own.
std::vector<std::size_t> shuffled(std::size_t lanes, std::uint64_t seed, int frame) {
  std::vector<std::size_t> order(lanes);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::uint64_t own = hash_bits(seed, static_cast<std::uint64_t>(frame));
  std::sort(order.begin(), order.end(),
            [own](std::size_t a, std::size_t b) { return hash_bits(own, a) < hash_bits(own, b); });
  return order;
}

/// Draws what sends most, as often as the stream has buffers in turn: they grow to that, and their pages are touched.
void warm_up(ReadyLanes& ready, std::size_t lanes) {
  std::size_t most = 0, largest = 0;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const std::size_t bytes = ready.stream_bytes(lane, 0);
    if (bytes > most) most = bytes, largest = lane;
  }
  for (int i = 0; i < 3; ++i) ready.frame(largest, 0);
}

void mark_dirty(PaperRun& run, int part) {
  for (LaneCosts& lane : run.lanes)
    for (auto i = static_cast<std::size_t>(part); i < lane.frames.size();
         i += static_cast<std::size_t>(run.options.parts))
      lane.frames[i].dirty = true;
}

/// A software renderer draws with all cores.
int threads(const PaperRun& run) {
  return gl::software_renderer(run.renderer) ? static_cast<int>(std::thread::hardware_concurrency()) : 1;
}

void run_part(PaperRun& run, ReadyLanes& ready, double& best_calibration_ms, const Tell& tell) {
  const PaperOptions& o = run.options;
  const apps::Watch watch;
  for (int frame = run.parts_done; frame < o.frames; frame += o.parts) {
    tell.progress((run.parts_done + static_cast<double>(frame) / o.frames) / o.parts);
    for (const std::size_t lane : shuffled(run.lanes.size(), o.seed, frame))
      run.lanes[lane].frames[static_cast<std::size_t>(frame)] = ready.frame(lane, frame);
  }
  const apps::Conditions during = watch.stop();
  best_calibration_ms = std::min(best_calibration_ms, during.calibration_ms);
  if (disturbed(during, best_calibration_ms, threads(run))) mark_dirty(run, run.parts_done);
  ++run.parts_done;
  tell.part(run);
}

}  // namespace

std::vector<Lane> paper_lanes() {
  using enum Residency;
  std::vector<Lane> lanes;
  add_lanes(lanes, {.city = "C2"}, {"none", "vam-block8", "vam-block6", "vam-block1", "bqr-paper", "bqr"},
            {resent, resident});
  for (const char* city : {"C1", "C3", "C4", "C5", "C6"})
    add_lanes(lanes, {.city = city}, {"vam-block8", "vam-block6", "bqr-paper"}, {resent});
  for (const std::uint32_t cars : {0U, 100U})
    add_lanes(lanes, {.city = "C2", .levels = kOneLevel, .cars = cars}, {"vam-block8", "bqr-paper"}, {resent});
  for (const std::uint32_t cars : {1'000U, 10'000U}) {
    const Lane one{.city = "C2", .levels = kOneLevel, .cars = cars},
        five{.city = "C2", .levels = kFiveLevels, .cars = cars};
    add_lanes(lanes, one, {"vam-block8", "bqr-paper"}, {resent, cars_resident, resident});
    add_lanes(lanes, five, {"vam-block8", "bqr-paper"}, {resent});
    Lane eager = one;
    eager.attach = Attach::eager;
    add_lanes(lanes, eager, {"bqr-paper"}, {resent});
  }
  return lanes;
}

PaperRun unmeasured(const std::vector<Lane>& lanes, const PaperOptions& options) {
  assert(options.parts >= 1 && options.parts <= options.frames);
  PaperRun run{options, {}, 0, {}};
  for (const Lane& lane : lanes)
    run.lanes.push_back({lane, 0, std::vector<FrameCost>(static_cast<std::size_t>(options.frames))});
  return run;
}

void measure(PaperRun& run, const Tell& tell) {
  if (run.parts_done == run.options.parts) return;
  const auto begin = Clock::now();
  tell.progress(static_cast<double>(run.parts_done) / run.options.parts);
  std::vector<Lane> lanes;
  for (const LaneCosts& costs : run.lanes) lanes.push_back(costs.lane);
  Stage stage(run.options.width, run.options.height);
  ReadyLanes ready(lanes, run.options, stage);
  for (std::size_t i = 0; i < lanes.size(); ++i) run.lanes[i].city_triangles = ready.city_triangles(i);
  warm_up(ready, lanes.size());
  double longest_s = 0, best_calibration_ms = apps::calibrate_ms();
  while (run.parts_done < run.options.parts &&
         (run.parts_done == 0 || seconds_since(begin) + longest_s <= run.options.budget_s)) {
    const double before_s = seconds_since(begin);
    run_part(run, ready, best_calibration_ms, tell);
    longest_s = std::max(longest_s, seconds_since(begin) - before_s);
  }
  tell.progress(1);
}

}  // namespace manzana::paper

#include "apps/culling_benchmark/paper_job.h"

#include <algorithm>
#include <cassert>
#include <chrono>

#include "culling/baselines/cases.h"

namespace manzana::paper {
namespace {

using Clock = std::chrono::steady_clock;

double ms(Clock::duration duration) { return std::chrono::duration<double, std::milli>(duration).count(); }

Streets streets_of(const Job& job, std::uint64_t seed) {
  const auto* which = baselines::find_case(job.city);
  assert(which != nullptr);
  baselines::City city = baselines::make_city(*which, seed);
  return job.levels.empty() ? Streets{std::move(city), {}} : make_streets(city, job.cars, seed);
}

}  // namespace

ReadyJob::ReadyJob(const Job& job, const PaperOptions& options, Stage& stage)
    : job_(job), stage_(stage), streets_(streets_of(job, options.seed)), fleet_(job.levels), seen_(job.levels) {
  add_structures(make_geometry(streets_.city));
  for (int i = 0; i < options.frames; ++i) {
    const double t = static_cast<double>(i) / std::max(1, options.frames - 1);
    const culling::View view = baselines::flight(streets_.city, std::numeric_limits<double>::infinity(), t);
    views_.push_back({view, culling::make_frustum(view), ticks(t * kFlightSeconds)});
  }
}

void ReadyJob::add_structures(const Geometry& rows) {
  for (const Lane& lane : job_.lanes) {
    const auto same =
        std::find_if(job_.lanes.begin(), job_.lanes.end(), [&](const Lane& l) { return l.peer == lane.peer; });
    const auto first = static_cast<std::size_t>(same - job_.lanes.begin());
    if (first < structure_of_.size()) {
      structure_of_.push_back(structure_of_[first]);
      continue;
    }
    structure_of_.push_back(structures_.size());
    const bool on_device = std::any_of(job_.lanes.begin(), job_.lanes.end(), [&](const Lane& l) {
      return l.peer == lane.peer && l.residency == Residency::resident;
    });
    auto peer = baselines::find_peer(lane.peer)->make(streets_.city);
    CityModel model(arranged(rows, peer->order()), on_device);
    StreetFinder finder = job_.levels.empty() ? StreetFinder() : StreetFinder(streets_, peer->order());
    structures_.push_back({std::move(peer), std::move(model), std::move(finder)});
  }
}

void ReadyJob::query(Structure& structure, Attach attach, const FrameView& at) {
  structure.peer->query(at.frustum, answer_);
  if (job_.levels.empty()) return;
  structure.finder.find(answer_.runs, blocks_);
  attach_cars(streets_, blocks_, at.tick, attach, seen_);
  choose_levels(at.view, stage_.height(), seen_);
}

FrameCost ReadyJob::frame(std::size_t lane, int i) {
  const FrameView& at = views_.at(static_cast<std::size_t>(i));
  Structure& structure = structures_[structure_of_.at(lane)];
  const Lane& how = job_.lanes[lane];
  const auto begin = Clock::now();
  query(structure, how.attach, at);
  const auto found = Clock::now();
  stage_.draw(structure.model, answer_.runs, fleet_, seen_, at.view, how.residency);
  const auto sent = Clock::now();
  glFinish();
  const auto end = Clock::now();
  return {true, ms(found - begin), ms(sent - found), ms(end - sent),
          triangles(structure.model.geometry, answer_.runs) + seen_.triangles()};
}

}  // namespace manzana::paper

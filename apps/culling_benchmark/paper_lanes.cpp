#include "apps/culling_benchmark/paper_lanes.h"

#include <chrono>
#include <numeric>

#include "culling/baselines/cases.h"

namespace manzana::paper {
namespace {

using Clock = std::chrono::steady_clock;

double ms(Clock::duration duration) { return std::chrono::duration<double, std::milli>(duration).count(); }

}  // namespace

ReadyLanes::ReadyLanes(const std::vector<Lane>& lanes, const PaperOptions& options, Stage& stage)
    : options_(options), stage_(stage) {
  for (const Lane& lane : lanes) {
    Structure& structure = structure_of(lane);
    if (lane.residency == Residency::resident) structure.model->put_on_device();
    lanes_.push_back({lane, &scene_of(lane), &structure, &traffic_of(lane.city, lane.cars), &fleet_of(lane.levels)});
  }
  for (auto& [key, scene] : scenes_) scene.rows = {};  // each structure has its own
}

ReadyLanes::Scene& ReadyLanes::scene_of(const Lane& lane) {
  const auto [at, is_new] = scenes_.try_emplace({lane.city, !lane.levels.empty()});
  Scene& scene = at->second;
  if (!is_new) return scene;
  scene.city = baselines::make_city(*baselines::find_case(lane.city), options_.seed);
  if (!lane.levels.empty()) scene.city = with_streets(scene.city, traffic_of(lane.city, 0));
  scene.rows = make_geometry(scene.city);
  for (int i = 0; i < options_.frames; ++i) {
    const double t = flight_at(i, options_.frames);
    const culling::View view = baselines::flight(scene.city, std::numeric_limits<double>::infinity(), t);
    scene.views.push_back({view, culling::make_frustum(view), ticks(t * kFlightSeconds)});
  }
  return scene;
}

const Traffic& ReadyLanes::traffic_of(const std::string& city, std::uint32_t cars) {
  const auto [at, is_new] = traffic_.try_emplace({city, cars});
  if (is_new)
    at->second = make_traffic(baselines::make_city(*baselines::find_case(city), options_.seed), cars, options_.seed);
  return at->second;
}

const Fleet& ReadyLanes::fleet_of(std::span<const CarLevel> levels) {
  return fleets_.try_emplace(levels.size(), levels).first->second;
}

ReadyLanes::Structure& ReadyLanes::structure_of(const Lane& lane) {
  const Scene& scene = scene_of(lane);
  const auto [at, is_new] = structures_.try_emplace({&scene, lane.peer});
  Structure& structure = at->second;
  if (!is_new) return structure;
  structure.peer = baselines::find_peer(lane.peer)->make(scene.city);
  structure.model = std::make_unique<CityModel>(arranged(scene.rows, structure.peer->order()));
  if (!lane.levels.empty()) structure.finder = StreetFinder(scene.city, structure.peer->order());
  return structure;
}

std::uint64_t ReadyLanes::city_triangles(std::size_t lane) const {
  const auto& triangles = lanes_.at(lane).scene->city.triangles;
  return std::accumulate(triangles.begin(), triangles.end(), std::uint64_t{0});
}

void ReadyLanes::query(const Ready& ready, const FrameView& at) {
  ready.structure->peer->query(at.frustum, answer_);
  blocks_.clear();
  if (!ready.lane.levels.empty()) ready.structure->finder.find(answer_.runs, blocks_);
  attach_cars(*ready.traffic, blocks_, at.tick, ready.lane.attach, seen_);
  choose_levels(ready.lane.levels, at.view, stage_.height(), seen_);
}

std::size_t ReadyLanes::stream_bytes(std::size_t lane, int i) {
  const Ready& ready = lanes_.at(lane);
  query(ready, ready.scene->views.at(static_cast<std::size_t>(i)));
  return paper::stream_bytes(*ready.structure->model, answer_.runs, *ready.fleet, seen_, ready.lane.residency);
}

FrameCost ReadyLanes::frame(std::size_t lane, int i) {
  const Ready& ready = lanes_.at(lane);
  const FrameView& at = ready.scene->views.at(static_cast<std::size_t>(i));
  const CityModel& model = *ready.structure->model;
  const auto begin = Clock::now();
  query(ready, at);
  const auto found = Clock::now();
  stage_.draw(model, answer_.runs, *ready.fleet, seen_, at.view, ready.lane.residency);
  const auto sent = Clock::now();
  glFinish();
  const auto end = Clock::now();
  return {true, ms(found - begin), ms(sent - found), ms(end - sent),
          triangles(model.geometry, answer_.runs) + seen_.triangles};
}

}  // namespace manzana::paper

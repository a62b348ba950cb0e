#include "apps/culling_benchmark/cars.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "apps/common/clock.h"
#include "apps/culling_benchmark/paper_streets.h"
#include "culling/baselines/cases.h"

namespace manzana::culling_benchmark {
namespace {

using baselines::City;
using baselines::ObjectKind;

constexpr double kFovy = std::numbers::pi / 3, kAspect = 16.0 / 9.0;
constexpr double kFocalPx = 1000;
constexpr std::uint64_t kFirstTick = 60 * static_cast<std::uint64_t>(kTicksPerSecond), kTicksAFrame = 50;

/// What stands there. Parked cars are left out: those that drive take their place.
SceneObjects objects_of(const City& city) {
  SceneObjects objects;
  for (std::uint32_t block = 0; block < city.blocks.size(); ++block)
    for (std::uint32_t row = city.first[block]; row < city.first[block + 1]; ++row)
      if (city.kinds[row] != ObjectKind::car)
        objects.add(block, city.boxes[row], city.kinds[row] == ObjectKind::tree ? kTree : kBuilding);
  return objects;
}

culling::View view_from(const Vec3d& at, double angle, double away) {
  const Vec3d from{std::cos(angle), std::sin(angle), 1};
  return culling::look(at + away * from, -from, Vec3d(0, 0, 1), kFovy, kAspect);
}

std::size_t cars_in(const Scene& scene, const culling::View& view, VisibleSets& sets) {
  find_visible(scene, view, Structure::bqr, sets);
  find_cars(scene, kFirstTick, sets);
  return sets.cars.size();
}

/// What is in view grows with the square of the distance; starts from the last frame's.
double distance_for(const Scene& scene, const Vec3d& at, double angle, double in_view, double away, VisibleSets& sets) {
  for (int i = 0; i < 20; ++i) {
    const double ratio =
        in_view / static_cast<double>(std::max<std::size_t>(cars_in(scene, view_from(at, angle, away), sets), 1));
    if (std::abs(ratio - 1) < 0.01) break;
    away *= std::sqrt(ratio);
  }
  return away;
}

}  // namespace

Scene make_cars_scene(std::uint32_t cars, std::uint64_t seed) {
  const City plain = baselines::make_city(cars, seed);
  Scene scene;
  scene.traffic = paper::make_traffic(plain, cars, seed);
  City city = paper::with_streets(plain, scene.traffic);
  for (culling::BlockVolume& block : city.blocks) block.classes = kCar;
  scene.tree = build_tree(city.blocks, objects_of(city)).tree;
  scene.bounds = city.bounds;
  std::vector<std::uint32_t> new_of_old(city.blocks.size());
  for (std::uint32_t b = 0; b < scene.tree.blocks(); ++b) {
    new_of_old[scene.tree.order[b]] = b;
    scene.blocks.push_back({Vec3d(city.blocks[scene.tree.order[b]].center, 0), Mat3d(1.0)});
  }
  reorder_blocks(scene.traffic, new_of_old);
  return scene;
}

std::vector<culling::View> fly(const Scene& scene, const CarsFlight& flight) {
  const Vec3d size = scene.bounds.max - scene.bounds.min;
  const Vec3d middle(Vec2d(culling::center(scene.bounds)), scene.bounds.min.z);
  const bool all = scene.traffic.cars() <= flight.in_view;
  const double round = all ? 0 : 0.2 * std::min(size.x, size.y);
  double away = 1.5 * glm::length(size) * std::sqrt(std::min(1.0, flight.in_view / double(scene.traffic.cars())));
  VisibleSets sets(scene);
  std::vector<culling::View> views;
  for (int frame = 0; frame < flight.frames; ++frame) {
    const double angle = frame * flight.metres_a_frame / (0.2 * std::min(size.x, size.y));
    const Vec3d at = middle + round * Vec3d(std::cos(angle), std::sin(angle), 0);
    if (!all) away = distance_for(scene, at, angle, flight.in_view, away, sets);
    views.push_back(view_from(at, angle, away));
  }
  return views;
}

CarsBuffers::CarsBuffers(const Scene& scene)
    : sets(scene), selection(scene.traffic.cars()), instances(draw::most_instances(scene.traffic.cars())) {}

CarsFrame cars_frame(const Scene& scene, const culling::View& view, std::uint64_t tick, CarsBuffers& buffers) {
  CarsFrame frame;
  const auto start = apps::Clock::now();
  find_visible(scene, view, Structure::bqr, buffers.sets);
  frame.query_us = apps::us_since(start);
  frame.work = find_cars(scene, tick, buffers.sets);
  frame.find_us = apps::us_since(start) - frame.query_us;
  const std::vector<CarState>& cars = buffers.sets.cars;
  draw::count_cars(cars, view.eye, kFocalPx, buffers.selection);
  draw::place_cars(scene, cars, view.eye, buffers.selection, buffers.instances.data());
  frame.lists_us = apps::us_since(start) - frame.query_us - frame.find_us;
  frame.in_view = cars.size();
  return frame;
}

namespace {

using Field = double (*)(const CarsFrame&);
constexpr Field kQuery = [](const CarsFrame& f) { return f.query_us; };
constexpr Field kFind = [](const CarsFrame& f) { return f.find_us; };
constexpr Field kLists = [](const CarsFrame& f) { return f.lists_us; };
constexpr Field kAll = [](const CarsFrame& f) { return f.all_us(); };

double mean_of(const std::vector<CarsFrame>& frames, Field field) {
  double sum = 0;
  for (const CarsFrame& f : frames) sum += field(f);
  return sum / static_cast<double>(frames.size());
}

double median_of(const std::vector<CarsFrame>& frames, Field field) {
  std::vector<double> values;
  for (const CarsFrame& f : frames) values.push_back(field(f));
  return apps::median(std::move(values));
}

/// One city on one flight, with the frames of every round.
struct Lane {
  const Scene& scene;
  std::vector<culling::View> views;
  CarsBuffers buffers;
  std::vector<std::vector<CarsFrame>> rounds;

  Lane(const Scene& city, const CarsFlight& flight) : scene(city), views(fly(city, flight)), buffers(city) {}

  void fly_round() {
    std::vector<CarsFrame>& frames = rounds.emplace_back();
    for (std::size_t i = 0; i < views.size(); ++i)
      frames.push_back(cars_frame(scene, views[i], kFirstTick + i * kTicksAFrame, buffers));
  }

  double median_us(Field field) const {
    std::vector<double> medians;
    for (const auto& round : rounds) medians.push_back(median_of(round, field));
    return apps::median(std::move(medians));
  }
};

CarsRow row_of(const Lane& lane, const Lane& first, const CarsFlight& flight) {
  CarsRow row;
  row.cars = lane.scene.traffic.cars();
  row.blocks = lane.scene.tree.blocks();
  row.metres_a_frame = flight.metres_a_frame;
  const std::vector<CarsFrame>& any = lane.rounds.front();
  row.in_view = mean_of(any, [](const CarsFrame& f) { return static_cast<double>(f.in_view); });
  row.half_streets = mean_of(any, [](const CarsFrame& f) { return static_cast<double>(f.work.half_streets); });
  row.looked_at = mean_of(any, [](const CarsFrame& f) { return static_cast<double>(f.work.cars); });
  row.query_us = lane.median_us(kQuery);
  row.find_us = lane.median_us(kFind);
  row.lists_us = lane.median_us(kLists);
  row.all_us = lane.median_us(kAll);
  std::vector<double> ratios;
  for (std::size_t i = 0; i < lane.rounds.size(); ++i)
    ratios.push_back(median_of(lane.rounds[i], kAll) / median_of(first.rounds[i], kAll));
  row.ratio = apps::median_ratio(ratios);
  const apps::Interval interval = apps::median_interval(ratios);
  row.ratio_lo = interval.low;
  row.ratio_hi = interval.high;
  return row;
}

}  // namespace

CarsRun run_cars(const CarsOptions& options, const std::function<void(double)>& progress) {
  std::vector<Scene> scenes;
  for (const std::uint32_t cars : options.cars) scenes.push_back(make_cars_scene(cars, options.seed));
  CarsRun run{options, {}};
  std::mt19937_64 dice(options.seed);
  const double steps = static_cast<double>(options.flights.size()) * (options.rounds + 1);
  double done = 0;
  for (const CarsFlight& flight : options.flights) {
    std::vector<Lane> lanes;
    lanes.reserve(scenes.size());
    for (const Scene& scene : scenes) lanes.emplace_back(scene, flight);
    std::vector<Lane*> order;
    for (Lane& lane : lanes) order.push_back(&lane);
    for (int round = 0; round <= options.rounds; ++round) {
      std::shuffle(order.begin(), order.end(), dice);
      for (Lane* lane : order) lane->fly_round();
      progress(++done / steps);
    }
    for (Lane& lane : lanes) lane.rounds.erase(lane.rounds.begin());  // buffers were new
    for (const Lane& lane : lanes) run.rows.push_back(row_of(lane, lanes.front(), flight));
  }
  return run;
}

}  // namespace manzana::culling_benchmark

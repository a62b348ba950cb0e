// What moving cars cost, counted: no clock is read here.
#include "apps/culling_benchmark/cars.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <iostream>
#include <sstream>

#include "culling/baselines/exact.h"
#include "tests/support/temporary_folder.h"

namespace manzana::culling_benchmark {
namespace {

constexpr std::uint64_t kTick = 100'000;

/// A flag a block of the last answer.
std::vector<char> blocks_of(const Scene& scene, const VisibleSets& sets) {
  std::vector<char> seen(scene.tree.blocks(), 0);
  for (const culling::LeafRun& run : sets.blocks()) std::fill(seen.begin() + run.first, seen.begin() + run.last, 1);
  return seen;
}

std::uint64_t half_streets_of(const Scene& scene, const std::vector<char>& blocks) {
  std::uint64_t sum = 0;
  for (const HalfStreet& half : scene.traffic.halves) sum += blocks[half.block] != 0 ? 1 : 0;
  return sum;
}

bool holds(const std::vector<CarState>& cars, std::uint32_t car) {
  return std::any_of(cars.begin(), cars.end(), [&](const CarState& c) { return c.car == car; });
}

/// By looking at every car there is: how many are on the seen blocks, and of those in view how many were not found.
struct Census {
  std::uint64_t on_blocks = 0, in_view = 0, missed = 0;
};
Census census(const Scene& scene, const culling::View& view, const VisibleSets& sets) {
  const culling::ExactView exact = culling::make_exact(view);
  const std::vector<char> blocks = blocks_of(scene, sets);
  Census all;
  for (std::uint32_t car = 0; car < scene.traffic.cars(); ++car) {
    const CarState state = car_at(scene.traffic, car, kTick);
    all.on_blocks += blocks[scene.traffic.halves[state.half].block] != 0 ? 1 : 0;
    if (!culling::exactly_overlaps(exact, {state.position - 1.0, state.position + 1.0})) continue;
    ++all.in_view;
    all.missed += holds(sets.cars, car) ? 0 : 1;
  }
  return all;
}

CarStats mean_work(const Scene& scene) {
  CarsBuffers buffers(scene);
  CarStats sum;
  const auto views = fly(scene, {.metres_a_frame = 300, .frames = 5});
  for (const culling::View& view : views) {
    const CarsFrame frame = cars_frame(scene, view, kTick, buffers);
    CHECK(frame.in_view == Approx(10'000).epsilon(0.015));
    sum += frame.work;
  }
  return {sum.half_streets / views.size(), sum.cars / views.size()};
}

}  // namespace

TEST_CASE("moving cars: only the half-streets of seen blocks are asked and only cars on them looked at") {
  const Scene scene = make_cars_scene(4000, 3);
  CarsBuffers buffers(scene);
  std::uint64_t in_view = 0;
  for (const culling::View& view : fly(scene, {.in_view = 400, .metres_a_frame = 90, .frames = 12})) {
    const CarsFrame frame = cars_frame(scene, view, kTick, buffers);
    const Census all = census(scene, view, buffers.sets);
    CHECK(all.missed == 0);
    CHECK(frame.in_view >= all.in_view);
    CHECK(frame.in_view <= all.on_blocks);
    CHECK(frame.work.half_streets == half_streets_of(scene, blocks_of(scene, buffers.sets)));
    CHECK(frame.work.cars >= all.on_blocks);
    CHECK(frame.work.cars <= all.on_blocks + frame.work.half_streets);  // the one behind ends the search
    in_view += all.in_view;
  }
  CHECK(in_view > 12 * 300);
}

TEST_CASE("moving cars: 10 000 in view of 1 000 000 take little more work than 10 000 of 10 000") {
  const CarStats few = mean_work(make_cars_scene(10'000, 1)), many = mean_work(make_cars_scene(1'000'000, 1));
  std::cout << "cars looked at, half-streets: " << few.cars << ", " << few.half_streets << " of 10 000; " << many.cars
            << ", " << many.half_streets << " of 1 000 000\n";
  CHECK(few.half_streets == 1600);
  CHECK(many.half_streets < 1.3 * double(few.half_streets));  // those of the blocks that cross
  CHECK(many.cars < 1.3 * double(few.cars));
}

TEST_CASE("moving cars: lists hold every car in view once, sorted by mesh") {
  const Scene scene = make_cars_scene(1000, 5);
  CarsBuffers buffers(scene);
  const culling::View view = fly(scene, {.in_view = 200, .frames = 1}).front();
  const CarsFrame frame = cars_frame(scene, view, kTick, buffers);
  REQUIRE(frame.in_view > 150);
  const std::uint32_t all = buffers.selection.bins.total();
  CHECK(buffers.selection.bins.next.back() == all);
  // A car between two levels has a second instance, with the same share below 0.
  const auto end = buffers.instances.begin() + static_cast<std::ptrdiff_t>(all);
  const auto count = [&](auto&& is) { return std::count_if(buffers.instances.begin(), end, is); };
  CHECK(count([](const draw::Instance& i) { return i.extra.w > 0; }) == static_cast<std::ptrdiff_t>(frame.in_view));
  CHECK(count([](const draw::Instance& i) { return i.extra.w > 0 && i.extra.w < 1; }) ==
        count([](const draw::Instance& i) { return i.extra.w < 0; }));
  for (const CarState& car : buffers.sets.cars) {
    const draw::Instance expected = draw::place_car(car, {0, 0, 1}, view.eye);
    CHECK(count([&](const draw::Instance& i) {
            return i.rows == expected.rows && Vec3(i.extra) == Vec3(expected.extra) && i.extra.w > 0;
          }) == 1);
  }
}

TEST_CASE("moving cars: a row a city and flight, in a file and in the report") {
  const CarsOptions options{
      .cars = {500, 2000}, .flights = {{.in_view = 500, .metres_a_frame = 7, .frames = 3}}, .rounds = 3};
  double done = 0;
  const CarsRun run = run_cars(options, [&](double now) {
    CHECK(now > done);
    done = now;
  });
  CHECK(done == 1);
  REQUIRE(run.rows.size() == 2);
  CHECK(run.rows[0].ratio == 1);
  CHECK(run.rows[1].cars == 2000);
  CHECK(run.rows[1].in_view == Approx(500).epsilon(0.03));
  CHECK(run.rows[1].all_us > 0);
  const TemporaryFolder folder;
  write_cars(folder.path(), run);
  std::stringstream csv;
  csv << std::ifstream(folder.path() / "cars.csv").rdbuf();
  CHECK(csv.str().starts_with("cars,blocks,metres_a_frame,in_view,"));
  const std::string text = cars_md(run);
  CHECK(text.starts_with("## Moving cars\n"));
  CHECK(text.find("| 2 000 | ") != std::string::npos);
  CHECK(text.find("7.00 m a frame") != std::string::npos);
}

}  // namespace manzana::culling_benchmark

#pragma once
/// What moving cars cost a frame when the city grows and the cars in view do not: all that is done about them, from
/// the query to the lists that are handed to drawing, with the functions that draw a scene.
///   const CarsRun run = run_cars({}, [](double done) { ... });
///   write_cars(folder, run);                    // cars.csv
///   report += cars_md(run);
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "apps/common/statistics.h"
#include "scenegraph/draw/select_cars.h"
#include "scenegraph/visible.h"

namespace manzana::culling_benchmark {

/// A generated city with moving cars, 25 a block, and about as many objects.
Scene make_cars_scene(std::uint32_t cars, std::uint64_t seed);

/// Round the middle of the city, looking at what goes by, from so far that about `in_view` cars are in view in every
/// frame; all of the city if it has no more.
struct CarsFlight {
  std::uint32_t in_view = 10'000;
  double metres_a_frame = 0.5;
  int frames = 60;
};
std::vector<culling::View> fly(const Scene& scene, const CarsFlight& flight);

/// What a frame needs, kept from frame to frame.
struct CarsBuffers {
  explicit CarsBuffers(const Scene& scene);
  VisibleSets sets;
  draw::CarSelection selection;
  std::vector<draw::Instance> instances;  ///< in place of what the device would read
};
struct CarsFrame {
  double query_us = 0, find_us = 0, lists_us = 0;
  std::uint64_t in_view = 0;  ///< cars that are drawn
  CarStats work;
  double all_us() const { return query_us + find_us + lists_us; }
};
CarsFrame cars_frame(const Scene& scene, const culling::View& view, std::uint64_t tick, CarsBuffers& buffers);

struct CarsOptions {
  std::uint64_t seed = 1;
  std::vector<std::uint32_t> cars{10'000, 100'000, 1'000'000};   ///< of each city; the first's time is the measure
  std::vector<CarsFlight> flights{{}, {.metres_a_frame = 500}};  ///< a camera that moves, and one that jumps
  int rounds = 31;
};

/// Medians over the rounds of the medians over the frames; numbers are means of a frame.
struct CarsRow {
  std::uint64_t cars = 0, blocks = 0;
  double metres_a_frame = 0;
  double in_view = 0, half_streets = 0, looked_at = 0;
  double query_us = 0, find_us = 0, lists_us = 0, all_us = 0;
  double ratio = 0, ratio_lo = 0, ratio_hi = 0;  ///< of all_us to the first city's
};
struct CarsRun {
  CarsOptions options;
  std::vector<CarsRow> rows;
};
CarsRun run_cars(const CarsOptions& options, const std::function<void(double)>& progress);

/// The time of the largest city over that of the smallest is meant to be less.
inline constexpr double kMostCarsGrowth = 3;

/// Throws std::runtime_error when the file cannot be written.
void write_cars(const std::filesystem::path& folder, const CarsRun& run);
std::string cars_md(const CarsRun& run);
std::string cars_columns_md();

}  // namespace manzana::culling_benchmark

#pragma once
/// The cars of the blocks that a structure has found, with the level of detail that each is drawn at.
///   finder.find(answer.runs, blocks);                          // each frame; no allocation once all have grown
///   attach_cars(traffic, blocks, tick, Attach::lazy, seen);
///   choose_levels(kFiveLevels, view, height, seen);
///   seen.instances: level by level, seen.count[level] of each
#include <array>
#include <span>

#include "apps/culling_benchmark/paper_streets.h"
#include "culling/bqr_tree.h"
#include "culling/frustum.h"

namespace manzana::paper {

/// Drawn when the ball of kCarRadius round the car has at least that radius in the picture, pixels.
struct CarLevel {
  std::uint32_t triangles;
  double min_radius_px;
};
inline constexpr std::array kOneLevel{CarLevel{387, 0}};
/// The paper names the triangles (figure 10) but not when each level is used; these limits are ours.
inline constexpr std::array kFiveLevels{CarLevel{1701, 60}, CarLevel{511, 30}, CarLevel{262, 15}, CarLevel{50, 5},
                                        CarLevel{18, 0}};
std::size_t level_of(std::span<const CarLevel> levels, double radius_px);

/// As the vertex shader reads it.
struct CarInstance {
  Vec3 position;       ///< in L
  std::uint32_t tint;  ///< as Corner::colour
  Vec2 forward;        ///< unit
};
static_assert(sizeof(CarInstance) == 24);

struct SeenCars {
  std::vector<CarInstance> instances;  ///< sorted by level
  std::vector<std::uint32_t> count;    ///< a row a level
  std::uint64_t triangles = 0;         ///< of all of them

  std::vector<CarState> states;     ///< of the cars found; scratch
  std::vector<std::uint8_t> level;  ///< of each state; scratch
  std::vector<char> in_view;        ///< a flag a block; scratch
};

/// Which blocks an answer holds: those whose half-streets it holds.
class StreetFinder {
 public:
  StreetFinder() = default;
  /// `city`: with streets. `order`: the structure's, position -> row of the city; empty: positions are rows.
  StreetFinder(const baselines::City& city, std::span<const std::uint32_t> order);
  /// `blocks` is cleared first.
  void find(std::span<const culling::ObjectRun> runs, std::vector<std::uint32_t>& blocks) const;

 private:
  struct Entry {
    std::uint32_t position, block;
  };
  std::vector<Entry> entries_;  // by position
};

/// When a car comes to another block: `lazy`, its place is looked for when its block is seen; `eager`, all cars are
/// brought up to date in every frame. The same answer.
enum class Attach : std::uint8_t { lazy, eager };

/// Fills states of the cars on these blocks at that tick.
void attach_cars(const Traffic& traffic, std::span<const std::uint32_t> blocks, std::uint64_t tick, Attach attach,
                 SeenCars& seen);
/// Chooses levels and sorts: states -> instances. height: of the picture in pixels.
void choose_levels(std::span<const CarLevel> levels, const culling::View& view, int height, SeenCars& seen);

}  // namespace manzana::paper

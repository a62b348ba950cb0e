#pragma once
/// Cars on closed circuits of half-streets.  [Pina 2009, 3.2; numerics 8]
/// A street has two half-streets, one for each direction, each of one block. At every junction each half-street that
/// comes in is paired with one that goes out, so that all half-streets fall into closed circuits. All cars of a circuit
/// follow one speed profile in closed form, each at a phase of its own: where a car is, is a function of time alone;
/// nothing is added up, nothing drifts, and any time can be asked for.
///   phase(car, t) = offset(car) + ticks(t) * step(circuit)      in 64-bit integers: 2^64 is one lap, and wraps by
///   itself; the step has 32 more bits behind the point, so that circuits keep in step with each other for ever
/// Attachment is lazy and exact without a list of pending changes: the cars of a half-street at time t are those whose
/// phase lies in its interval, that is one run of the circuit's cars in order of their offsets, found by bisection. So
/// an unseen car costs nothing at all, and none is ever lost.
#include <cstdint>
#include <span>
#include <vector>

#include "culling/volumes.h"
#include "scenegraph/column.h"

namespace manzana {

/// 3000 ticks a second: frames at 30, 50, 60, 75, 100 Hz fall on whole ticks.
inline constexpr double kTicksPerSecond = 3000;
std::uint64_t ticks(double seconds);  ///< nearest; negative times give 0

/// A stretch of a half-street's run with constant acceleration. Position s(t) = s0 + v0 dt + a dt^2 / 2, metres from
/// the half-street's start, dt = time within the piece, seconds.
struct MotionPiece {
  float t0 = 0, s0 = 0, v0 = 0, a = 0;  ///< t0: seconds since the car came onto this half-street
};

/// One direction of one street, from junction to junction, including the way over the junction at its end.
struct HalfStreet {
  std::uint32_t block = 0;
  std::uint32_t circuit = 0;
  std::uint32_t first_point = 0, last_point = 0;  ///< run of Traffic::points, at least two: the line that cars follow
  std::uint32_t first_piece = 0, last_piece = 0;  ///< run of Traffic::pieces
  std::uint64_t phase_begin = 0;                  ///< within the circuit: [phase_begin, next one's phase_begin)
  std::uint64_t phase_length = 0;                 ///< 0: the whole lap (the only half-street of its circuit)
  double duration_s = 0;
};

/// A point of a lane's centre line: the surface that wheels touch, metres in L, the length of the line so far, and the
/// unit tangent there, in L: a car's heading is blended between points, so that it turns without steps.
struct LanePoint {
  Vec3d position{0, 0, 0};
  double s = 0;
  Vec3d forward{0, 1, 0};
};

struct Circuit {
  std::uint32_t first_half = 0, last_half = 0;  ///< run of Traffic::halves in driving order
  std::uint32_t first_car = 0, last_car = 0;    ///< run of Traffic::offsets, ascending
  std::uint64_t step = 0;                       ///< phase a tick, whole part
  std::uint32_t step_fraction = 0;              ///< and the rest, in 2^-32
  double period_s = 0;
};
/// How far a car of this circuit has come since tick 0, modulo a lap.
std::uint64_t phase_run(const Circuit& circuit, std::uint64_t tick);

struct Traffic {
  std::vector<HalfStreet> halves;
  Column<LanePoint> points;
  std::vector<MotionPiece> pieces;
  std::vector<Circuit> circuits;
  std::vector<std::uint64_t> offsets;       ///< a row a car: phase at time 0
  std::vector<std::uint32_t> block_first;   ///< blocks + 1: rows of block_halves
  std::vector<std::uint32_t> block_halves;  ///< half-streets by block
  std::uint32_t cars() const { return static_cast<std::uint32_t>(offsets.size()); }
};

/// A car's radius over all models, metres: block volumes are enlarged by it round their half-streets.
inline constexpr double kCarRadius = 3.0;

/// Where a car is.
struct CarState {
  Vec3d position{0, 0, 0};  ///< in L, on the road
  Vec3d forward{0, 1, 0};   ///< unit, in L
  std::uint32_t car = 0;    ///< row of Traffic::offsets; also the seed of its colour and model
  std::uint32_t half = 0;
};

/// One car at a time, from scratch: the oracle, and for following a car. O(log) in the circuit's half-streets.
CarState car_at(const Traffic& traffic, std::uint32_t car, std::uint64_t tick);

/// What looking for cars took, so that work can be compared and not only time.
struct CarStats {
  std::uint64_t half_streets = 0;  ///< bisected
  std::uint64_t cars = 0;          ///< looked at after that
  CarStats& operator+=(const CarStats& more);
};

/// Appends the cars that are on the half-streets of `block` at that tick: exactly those whose car_at(...).half is of
/// the block. O(half-streets + log cars + cars found). No allocation while `out` has room.
CarStats cars_of_block(const Traffic& traffic, std::uint32_t block, std::uint64_t tick, std::vector<CarState>& out);

/// All that cars on this half-street can touch, in L: the box of its line, grown by kCarRadius.
culling::BoxD half_street_bounds(const Traffic& traffic, std::uint32_t half);

/// Rebuilds block_first and block_halves from HalfStreet::block, which must be under `blocks`.
void index_blocks(Traffic& traffic, std::uint32_t blocks);
/// Block b becomes new_of_old[b]; as many blocks as before.
void reorder_blocks(Traffic& traffic, std::span<const std::uint32_t> new_of_old);

}  // namespace manzana

#pragma once
/// Lanes: the lines that cars follow, along streets and over junctions, before anything is known about time.
/// Private to build_traffic.
///   std::vector<Lane> lanes = make_lanes(graph, left_hand);
///   std::vector<Vec3d> way = way_over_junction(lanes[a], lanes[b], left_hand);
/// All lines are (x, y in plan, height above ground), metres, in driving order.
#include <span>
#include <vector>

#include "scenegraph/import/street_graph.h"

namespace manzana {

inline constexpr double kSideAcceleration = 2.5;  ///< m/s^2, in bends
inline constexpr double kSlowest = 1.8;           ///< m/s, of the tightest turn

/// One direction of one street, from the end of a junction to the beginning of the next.
struct Lane {
  std::uint32_t edge = 0;
  bool against = false;  ///< against the edge's points
  std::uint32_t from = 0, to = 0;
  std::vector<Vec3d> line;  ///< at least two points, no two equal in plan
  double length = 0;        ///< in plan
  double speed = 8.5;       ///< limit, m/s
};

/// Lanes of all edges that carry traffic: two of a two-way street, one in the middle of a one-way street. They end
/// where the kerbs of neighbouring streets meet, and a little before, but never take more than the street is long.
/// Bends are rounded.
std::vector<Lane> make_lanes(const StreetGraph& graph, bool left_hand);

/// From the end of a lane to the beginning of another, both points included: straight on, a curve, or a half circle.
std::vector<Vec3d> way_over_junction(const Lane& in, const Lane& out, bool left_hand);

Vec2d start_direction(const Lane& lane);
Vec2d end_direction(const Lane& lane);
/// Angle to turn left from a to b, -pi to pi.
double turn_angle(const Vec2d& a, const Vec2d& b);
double plan_length(std::span<const Vec3d> line);
/// The speed at which the point i of a line is passed with kSideAcceleration on the circle through it and its
/// neighbours, m/s; infinite where it is straight.
double bend_speed(std::span<const Vec3d> line, std::size_t i);

}  // namespace manzana

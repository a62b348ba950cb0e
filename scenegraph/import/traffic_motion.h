#pragma once
/// Speeds: how a lane is driven, and how it is driven later. Private to build_traffic.
/// Way over a junction: at one speed. On the lane before: the free profile, as fast as bends, limits and kAcceleration
/// allow; or, to come later, the free profile cut off at a cruise speed u. The time over the lane falls as u rises, so
/// any time between the two is met by bisection, and no acceleration is ever above kAcceleration.
#include <vector>

#include "scenegraph/import/traffic_lanes.h"
#include "scenegraph/traffic.h"

namespace manzana {

inline constexpr double kAcceleration = 2.2;  ///< m/s^2, speeding up and braking
inline constexpr double kHeadwayGap = 6.5;    ///< metres from car to car along the line, at least: a cycle at u_min

inline constexpr double kNoCruise = 1e9;  ///< m/s: as fast as the free profile

/// Free speed at evenly spaced nodes of a lane; v^2 is linear from node to node.
struct LaneProfile {
  double spacing = 0;
  std::vector<double> speed;
};

/// Comes in at `first` and leaves at `last` m/s, which must be within reach of each other.
LaneProfile free_profile(const Lane& lane, double first, double last);
/// Seconds over the lane when the cruise speed is cut off at `cruise`. Falls as `cruise` rises.
double lane_time(const LaneProfile& profile, double cruise);
/// The cruise speed, at least `slowest`, that takes `seconds`.
double cruise_for(const LaneProfile& profile, double seconds, double slowest);

/// The pieces of a lane at that cruise speed, then of the way over the junction at `way_speed`. Along the plan.
void append_pieces(std::vector<MotionPiece>& pieces, const LaneProfile& profile, double cruise, double way_speed);

}  // namespace manzana

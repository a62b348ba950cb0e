#pragma once
/// Who may be on a junction when. Private to build_traffic.
/// A ride is a lane with the way over the junction at its end. Every ride sees one car a cycle at most, always at the
/// same time within the cycle: its slot, the time at which cars leave the lane and come onto the way. The delays on the
/// lanes make up for the difference between two slots, so slots can be chosen freely, ride by ride, and yet each lap of
/// a circuit takes a whole number of cycles. So all that ever can happen happens within one cycle.
#include <utility>
#include <vector>

#include "scenegraph/import/traffic_motion.h"

namespace manzana {

struct Ride {
  std::uint32_t lane = 0, next = 0, previous = 0;  ///< next, previous: rides
  std::vector<Vec3d> way;  ///< over the junction, from the lane's last point to the next's first
  double way_length = 0, way_speed = 0;
  LaneProfile profile;
  double way_time() const { return way_length / way_speed; }
};

/// Cars on the ways of both rides would touch if slot(a) - slot(b) were between low and high (seconds, modulo the
/// cycle).
struct Conflict {
  std::uint32_t a = 0, b = 0;
  double low = 0, high = 0;
};
/// By the outlines of cars, enlarged, moved along both ways and the ends of the lanes beside them. Rides of other
/// junctions count too.
std::vector<Conflict> find_conflicts(const std::vector<Lane>& lanes, const std::vector<Ride>& rides);

/// Pairs of rides where cars on one's lane would touch cars on the other's lane or way whatever their times.
std::vector<std::pair<std::uint32_t, std::uint32_t>> find_overlaps(const std::vector<Lane>& lanes,
                                                                   const std::vector<Ride>& rides);

struct Slots {
  double cycle = 0;                   ///< seconds
  std::vector<double> slot;           ///< a row a ride
  std::vector<double> delay;          ///< a row a ride: over its lane, above the free time
  std::vector<std::uint32_t> failed;  ///< rides whose slot is not free, or not reached with the slowest cruise speed
};
/// Chooses the slots with little delay: in driving order, each ride the first free slot; then whatever is in conflict
/// is moved (min-conflicts with growing noise), then all are moved to where the delays are least.
Slots choose_slots(const std::vector<Ride>& rides, const std::vector<Conflict>& conflicts, double cycle,
                   std::uint64_t seed);
/// Cars that are a cycle apart on one line keep kHeadwayGap when none is slower than this.
inline double slowest_cruise(double cycle) { return kHeadwayGap / cycle; }

}  // namespace manzana

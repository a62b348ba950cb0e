#pragma once
/// Ways for a walker along real streets: on the pavement where there is one free of walls and trunks, else in the lane.
///   StreetSearch search(scene.traffic, heart);
///   StreetRoute route = straight_routes(search, 3000, 1).front();    // from far out to the heart
///   std::vector<Vec3d> feet = walk_along(scene, obstacles, route, 8);
#include <cstdint>
#include <span>
#include <vector>

#include "apps/walkthrough/obstacles.h"
#include "scenegraph/scene.h"

namespace manzana::walkthrough {

/// A half-street, walked with or against its traffic.
struct StreetStep {
  std::uint32_t half = 0;
  bool against = false;
};
using StreetRoute = std::vector<StreetStep>;

/// All routes from the streets nearest to a place, found at once: Dijkstra over the half-streets in both directions,
/// where one that begins near another's end follows it; turning costs something, so that ways stay straight.
class StreetSearch {
 public:
  StreetSearch(const Traffic& traffic, const Vec2d& start);  ///< O(n log n) in the half-streets

  struct End {
    std::uint32_t state = 0;
    double cost = 0;      ///< metres walked, and a little more for turns
    double distance = 0;  ///< from the start, as the crow flies
  };
  std::vector<End> ends() const;                      ///< all that can be reached
  StreetRoute route_from(std::uint32_t state) const;  ///< from there to the start

 private:
  const Traffic& traffic_;
  Vec2d start_;
  std::vector<double> cost_;
  std::vector<std::uint32_t> parent_;
};

/// From far out straight to the place: of the ends at least half as far as the farthest (and within `farthest_m`),
/// those with the least detour, the best first. Empty without streets.
std::vector<StreetRoute> straight_routes(const StreetSearch& search, double farthest_m, std::size_t most);
/// About `length_m` long, ending at the place.
StreetRoute route_of_length(const StreetSearch& search, double length_m);

/// Where the feet go, (x, y, height above ground), every `step_m` metres, corners rounded.
std::vector<Vec3d> walk_along(const Scene& scene, const Obstacles& obstacles, const StreetRoute& route, double step_m);

/// Points along a polyline every `step_m` metres, its ends included.
std::vector<Vec3d> resample(std::span<const Vec3d> line, double step_m);

}  // namespace manzana::walkthrough

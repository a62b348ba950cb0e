#pragma once
/// The places, depths and fields of view at which culling goes wrong.  [numerics 1]
#include <array>
#include <limits>
#include <string_view>

#include "culling/vec.h"

namespace manzana::baselines {

struct Place {
  std::string_view name;
  Vec3d at;  ///< metres
};
inline constexpr std::array kPlaces{
    Place{"local", {0, 0, 0}},
    Place{"10 km", {1e4, -1e4, 50}},
    Place{"100 km", {1e5, 1e5, 1.7}},
    Place{"UTM", {676000, 4613000, 200}},
    Place{"ECEF", {4777000, -73500, 4229000}},
    Place{"antimeridian", {-6101000, 0, -1853000}},  // ECEF; y changes its sign there
    Place{"pole", {0, 0, 6356752}},                  // ECEF
};

struct Depths {
  double near_m, far_m;
};
inline constexpr std::array kDepths{
    Depths{1e-3, 1e2}, Depths{0.1, 5e3},  Depths{1, 5e3},
    Depths{0.1, 1e5},  Depths{0.01, 1e6}, Depths{0.01, std::numeric_limits<double>::infinity()},
};

/// Full angle along the height, degrees.
inline constexpr std::array kFieldsDeg{1e-3, 1.0, 60.0, 120.0, 179.0};
inline constexpr std::array kAspects{1e-3, 1.0, 16.0 / 9.0, 1e3};

}  // namespace manzana::baselines

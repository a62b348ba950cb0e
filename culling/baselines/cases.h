#pragma once
/// The generated cities of the benchmark, and the camera's flight: the same on every machine.
///   City city = make_city(*find_case("100k"), 1);
///   for (int i = 0; i < n; ++i) View view = flight(city, find_case("100k")->far_m, i / (n - 1.0));
/// C1 to C6 follow section 4.1 of Pina 2009: C1 and C2 are 96 blocks with 2 976 objects in the same volume, of 367 000
/// and of 1 688 023 triangles; C3, C4, C5 are C2 with one C1 beside it along x, y, the diagonal; C6 is C2 with three
/// C1.
#include <string_view>

#include "culling/baselines/city.h"
#include "culling/frustum.h"

namespace manzana::baselines {

struct Case {
  std::string_view name;  ///< C1 ... C6, 10k, 100k, 100k-1km, 100k-cold, 1M, 1M-1km
  std::string_view what;
  double far_m = std::numeric_limits<double>::infinity();
  bool cold = false;  ///< 96 MiB are streamed between two queries
};

std::span<const Case> cases();
/// nullptr: no such case.
const Case* find_case(std::string_view name);

City make_city(const Case& which, std::uint64_t seed);
/// A city of about that many objects, 25 a block; for the growth curves.
City make_city(std::uint32_t objects, std::uint64_t seed);
/// The same city at another place.
City moved(City city, const Vec3d& by);

/// Pina's figure 4 at t in [0, 1]: at the outskirts at eye level (1.7 m), a walk to the heart, straight up above the
/// roofs, a turn down, and a diagonal dive to the ground. 60 degrees high, 16:9, near plane at 0.1 m.
culling::View flight(const City& city, double far_m, double t);

}  // namespace manzana::baselines

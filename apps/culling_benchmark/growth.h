#pragma once
/// How the cost grows with the city: cases from a thousand to ten million objects, with everything in view, and with
/// all within 1 km in view; the latter also with cold caches, and on two threads at once.
///   const Growth* growth = find_growth("grow-100k-1km-cold");
#include <span>
#include <string>
#include <vector>

#include "culling/baselines/city.h"
#include "culling/frustum.h"

namespace manzana::culling_benchmark {

struct Growth {
  std::string name, what;
  std::uint32_t objects = 0;
  bool all_in_view = false, cold = false;
  int threads = 1;
};
/// By size, so that a city is made once.
std::span<const Growth> growth_cases();
/// nullptr: no such case.
const Growth* find_growth(const std::string& name);

/// The structures that are followed.
std::span<const std::string_view> growth_peers();

/// Whether this machine's memory holds such a city with any of these structures twice.
bool fits_memory(const Growth& growth);

/// Everything in view: from a circle round the city, looking at its middle. Else the flight, seen to 1 km.
std::vector<culling::View> growth_views(const Growth& growth, const baselines::City& city, int frames);

}  // namespace manzana::culling_benchmark

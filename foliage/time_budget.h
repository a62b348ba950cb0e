#pragma once
/// A budget in milliseconds, as one in vertices that follows measured times.
///   TimeBudget budget;
///   each frame: draw with budget.vertices; follow(budget, ms, wanted_ms, vertices_drawn);
/// What a frame costs is not known beforehand, and is measured late and with noise. So times are judged by their median
/// since the last step, after few frames where they are far off and after more where they are near; a band about the
/// wanted time is left alone; a step goes only part of the way, and then waits until it shows. What trees do not cause
/// bounds what they can give: where that alone takes too long, the fewest vertices are drawn.
#include <array>
#include <cstdint>

namespace manzana::foliage {

struct TimeBudget {
  static constexpr double kFewest = 2e4, kMost = 1e9;   ///< vertices
  static constexpr std::uint32_t kLag = 4;              ///< frames, until a step shows in measured times
  static constexpr std::uint32_t kFew = 5, kMany = 15;  ///< times, to judge by

  double vertices = 2e5;
  std::array<double, kMany> newest{};  ///< milliseconds, in a ring
  std::uint32_t frames = 0;            ///< since the last step
};

/// The next budget, after a frame of `ms` in which `drawn` vertices were shown. `wanted_ms` > 0; an `ms` that is not a
/// positive number changes nothing.
void follow(TimeBudget& budget, double ms, double wanted_ms, double drawn);

}  // namespace manzana::foliage

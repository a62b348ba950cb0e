#pragma once
/// How much plants pop as their detail changes, faded as our law has it, against the same law without fading.
///   std::vector<PopRow> rows = measure_popping(plants, plan, progress);
/// Either the camera is frozen and the error steps by 1 %, so that nothing but detail changes; or the camera comes
/// nearer by 1 % a frame, and what the reference changes meanwhile is taken off.  [accuracy-trade, section 3]
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "apps/common/record.h"
#include "apps/common/run_facts.h"
#include "apps/foliage_benchmark/image_error.h"
#include "apps/foliage_benchmark/stage.h"

namespace manzana::foliage_benchmark {

/// Steps are Step's, of the worst of all frames. Fractions of the whole sRGB range.
struct PopRow : apps::RunFacts {
  std::string plant, moving;  ///< error, camera
  double height_px = 0;       ///< of the plant, in the middle of the approach
  std::uint64_t frames = 0;
  double most = 0, strong = 0, mean = 0;  ///< faded
  double unfaded_most = 0, unfaded_strong = 0, unfaded_mean = 0;
  double ratio_most = 1, ratio_strong = 1, ratio_mean = 1;  ///< faded over unfaded
};
/// And a picture: before, after and the difference of the frame that steps most in the mean, faded above unfaded.
struct Popped {
  PopRow row;
  Picture sheet;
};
inline constexpr double kMostPopping = 0.85;  ///< of each ratio

struct PopPlan {
  std::vector<double> heights{256, 64, 16};
  double range = 2;  ///< the error, or the distance, goes from 1 / this to this times what it is
  double error_px = 1;
  std::string mode = "full";                             ///< of the run
  foliage::Detail (*change)(foliage::Detail) = nullptr;  ///< for tests: of what counts as faded
};

/// The camera comes nearer by 1 % a frame: what is there is so high in the middle of its way, and from 1 / `range` to
/// `range` times that. Pictures have one size.
std::vector<Shot> approach(const Extent& extent, double height_px, double range);

/// `progress` is called with [0, 1], `show` with what is new. What the record holds is not measured again; what is new
/// is kept there.
std::vector<PopRow> measure_popping(std::span<const foliage::PreparedPlant> plants, const PopPlan& plan,
                                    const std::function<void(double)>& progress,
                                    const std::function<void(const Popped&)>& show = {},
                                    apps::Record<PopRow>* record = nullptr);

std::span<const apps::Column<PopRow>> pop_columns();
std::string popping_md(std::span<const PopRow> rows);

}  // namespace manzana::foliage_benchmark

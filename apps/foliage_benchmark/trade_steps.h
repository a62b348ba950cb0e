#pragma once
/// How much each way of drawing pops: by how much a picture steps from frame to frame as the camera comes nearer, more
/// than all detail does, over the worst step of all detail.  [accuracy-trade, section 3: popping]
///   std::vector<StepRow> rows = measure_steps(stage, {{"oak", extent, {0, 1}, 64}}, settings, how, progress, record);
#include <algorithm>

#include "apps/foliage_benchmark/errors.h"

namespace manzana::foliage_benchmark {

/// Steps are the worst frame's Step::mean, of the whole sRGB range, as the product samples.
struct StepRow : ErrorRow {
  std::uint64_t frames = 0;
  double step = 0;            ///< less all detail's in the same frame
  double reference_step = 0;  ///< all detail's own worst
};
/// At most kMostPop is meant: so no frame steps by more than twice what the worst of all detail's does.
inline constexpr double kMostPop = 1;
inline double pop_of(const StepRow& row) { return row.step / std::max(row.reference_step, 1e-3); }

/// What the camera comes near to, and how high it is in the middle of that.
struct Approached {
  std::string name;
  Extent extent;
  foliage::Run run;  ///< of the stage's sites
  double height_px = 64;
};
struct HowApproached {
  double range = 1.4;  ///< of distances: from that times the middle one to it over that
  std::string mode = "full";
  Lazy<FarSide>* far = nullptr;  ///< for settings that have some
};
/// What the record holds is not measured again; what is new is kept there.
std::vector<StepRow> measure_steps(Stage& stage, std::span<const Approached> all, std::span<const Setting> settings,
                                   const HowApproached& how, const std::function<void(double)>& progress,
                                   apps::Record<StepRow>& record);

std::span<const apps::Column<StepRow>> step_columns();

}  // namespace manzana::foliage_benchmark

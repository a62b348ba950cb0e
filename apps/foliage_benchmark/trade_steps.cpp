#include "apps/foliage_benchmark/trade_steps.h"

#include <algorithm>

#include "apps/common/child.h"
#include "apps/foliage_benchmark/errors_report.h"
#include "apps/foliage_benchmark/popping.h"

namespace manzana::foliage_benchmark {
namespace {

/// From each frame to the next.
std::vector<double> steps_of(Stage& stage, const Approached& at, const std::vector<Shot>& shots, const Setting& setting,
                             Lazy<FarSide>* far) {
  std::vector<double> steps;
  Picture before;
  for (const Shot& shot : shots) {
    apps::throw_if_interrupted();
    const Sight sight{shot, {at.run}};
    Picture picture = stage.draw(sight.runs, shot, with_far(setting, sight, stage, far));
    if (before.width > 0) steps.push_back(step_between(before, picture).mean);
    before = std::move(picture);
  }
  return steps;
}

/// All ways of one approach; all detail is drawn when the first of them is not known yet.
class Approach {
 public:
  Approach(Stage& stage, const Approached& at, const HowApproached& how)
      : stage_(stage), at_(at), how_(how), shots_(approach(at.extent, at.height_px, how.range)) {}

  StepRow key(const Setting& setting) const {
    StepRow row;
    static_cast<apps::RunFacts&>(row) = apps::run_facts(how_.mode);
    row.plant = at_.name;
    row.height_px = at_.height_px;
    row.frames = shots_.size();
    set_way(setting, row);
    return row;
  }

  StepRow measure(const Setting& setting) {
    StepRow row = key(setting);
    const std::vector<double> steps = steps_of(stage_, at_, shots_, setting, how_.far);
    row.reference_step = std::ranges::max(*reference_);
    for (std::size_t i = 0; i < steps.size(); ++i) row.step = std::max(row.step, steps[i] - (*reference_)[i]);
    return row;
  }

 private:
  Stage& stage_;
  const Approached& at_;
  const HowApproached& how_;
  std::vector<Shot> shots_;
  Lazy<std::vector<double>> reference_{[this] { return steps_of(stage_, at_, shots_, {foliage::Law::full}, nullptr); }};
};

bool same_approach(const StepRow& a, const StepRow& b) { return same_kind(a, b) && a.frames == b.frames; }

using C = apps::Column<StepRow>;
const std::vector<C> kOwnColumns{
    C{"frames", "", "each 1 % nearer than the one before", &StepRow::frames},
    C{"step", "of sRGB", "mean of the plant's pixels, of the frame that steps most beyond all detail's own step",
      &StepRow::step},
    C{"reference_step", "of sRGB", "all detail's, of the frame in which it steps most", &StepRow::reference_step}};

}  // namespace

std::vector<StepRow> measure_steps(Stage& stage, std::span<const Approached> all, std::span<const Setting> settings,
                                   const HowApproached& how, const std::function<void(double)>& progress,
                                   apps::Record<StepRow>& record) {
  std::vector<StepRow> rows;
  for (const Approached& at : all) {
    Approach approach(stage, at, how);
    for (const Setting& setting : settings) {
      progress(static_cast<double>(rows.size()) / static_cast<double>(all.size() * settings.size()));
      const StepRow key = approach.key(setting);
      const StepRow* known = record.find([&](const StepRow& row) { return same_approach(row, key); });
      rows.push_back(known != nullptr ? *known : approach.measure(setting));
      if (known == nullptr) record.keep(rows.back());
    }
  }
  return rows;
}

std::span<const C> step_columns() {
  static const auto columns =
      apps::joined<StepRow>({apps::run_columns<StepRow>(), way_columns<StepRow>(), kOwnColumns});
  return columns;
}

}  // namespace manzana::foliage_benchmark

#include "apps/foliage_benchmark/ground.h"

#include <algorithm>
#include <cmath>

#include "apps/common/clock.h"
#include "apps/common/quantile.h"
#include "foliage/gl/ldm_sampler.h"
#include "foliage/make_ldm.h"

namespace manzana::foliage_benchmark {

using foliage::Law;

Ground::Ground(std::span<const foliage::PreparedPlant> plants, const std::vector<foliage::TreeSite>& sites,
               double most_full_quads)
    : most_full_quads_(most_full_quads),
      extents_(extents_of(plants)),
      stage_(plants, sites, {.quads = 1U << 23, .points = 1U << 22}) {
  stage_.set_law(Law::ours);
  costs_ = make_costs(stage_.table());
}

void Ground::make_packs(std::span<const foliage::PreparedPlant> plants) {
  constexpr int kFine = 2;
  if (far_) return;
  far_.emplace(plants.size(), shaders_with_mask());
  for (std::uint32_t i = 0; i < plants.size(); ++i) {
    foliage::LdmSamplerGl sampler(plants[i], kFine);
    add_pack(*far_, i, make_ldm_pack(ldm_ball(plants[i]), draw::kFarPack, std::ref(sampler)));
  }
}

HowDrawn Ground::how_drawn(const Runs& runs, const Shot& shot, double vertices) {
  stage_.set_law(Law::ours);
  const auto rows = rows_seen_from(shot.view.eye);
  const double error =
      error_for(costs_, stage_.table(), {stage_.sites(), rows, runs, 1 / shot.focal_px}, {.vertices = vertices});
  return {.error_px = error * shot.focal_px, .sampling = Sampling::product, .far = far_ ? &*far_ : nullptr};
}

void Ground::measure(const Shot& shot, double vertices, double seconds, TimeRow& row) {
  const Runs all = in_view(stage_, extents_, shot);
  const HowDrawn how = how_drawn(all, shot, vertices);
  row.covered_px = static_cast<double>(covered(stage_.draw(all, shot, how)));
  set_shown(stage_.shown(), row);
  if (far_) *row.primitives += 2 * far_->chosen.mosaics;
  row.error_px = how.error_px;
  row.trees = trees_of(all);
  row.reference_primitives = full_primitives(stage_, all);
  time(shot, how, all, seconds, row);
}

void Ground::time(const Shot& shot, const HowDrawn& how, const Runs& all, double seconds, TimeRow& row) {
  const auto primitives = static_cast<double>(full_primitives(stage_, all));
  const auto every = static_cast<std::uint32_t>(std::max(1.0, std::ceil(primitives / 2 / most_full_quads_)));
  const Runs some = in_view(stage_, extents_, shot, every);
  const auto ours = [&] {
    stage_.set_law(Law::ours);
    stage_.draw_only(all, shot, how);
  };
  const auto full = [&] {
    stage_.set_law(Law::full);
    stage_.draw_only(some, shot, {how.error_px, how.sampling});
  };
  PairTimes times = time_pairs(ours, full, seconds, 1);
  const auto drawn = static_cast<double>(std::max<std::uint64_t>(1, full_primitives(stage_, some)));
  for (double* value : {&times.reference_ms, &times.ratio, &times.ratio_lo, &times.ratio_hi})
    *value *= primitives / drawn;
  set_times(times, row);
}

void Ground::fly(std::span<const Shot> path, double vertices, int times, TimeRow& row) {
  std::vector<double> frames_ms, errors_px;
  for (const Shot& shot : path) {
    const Runs all = in_view(stage_, extents_, shot);
    const HowDrawn how = how_drawn(all, shot, vertices);
    double least = std::numeric_limits<double>::infinity();
    for (int round = 0; round < times; ++round) {
      const auto start = apps::Clock::now();
      stage_.draw_only(all, shot, how);
      least = std::min(least, apps::us_since(start) / 1000);
    }
    frames_ms.push_back(least);
    errors_px.push_back(how.error_px);
  }
  row.ms = apps::quantile(frames_ms, 0.5);
  row.ms_99 = apps::quantile(frames_ms, 0.99);
  row.error_px = apps::quantile(errors_px, 0.5);
  row.trees = stage_.sites().size();
}

}  // namespace manzana::foliage_benchmark

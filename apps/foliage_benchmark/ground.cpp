#include "apps/foliage_benchmark/ground.h"

#include <algorithm>
#include <cmath>

#include "apps/common/clock.h"
#include "apps/common/quantile.h"

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

void Ground::make_far(std::span<const foliage::PreparedPlant> plants) {
  if (!far_) far_.emplace(plants, stage_.sites());
}

std::vector<foliage::Run> Ground::in_view(const Shot& shot, std::uint32_t every) const {
  return foliage_benchmark::in_view(stage_, extents_, shot, every);
}

HowDrawn Ground::how_drawn(const Runs& runs, const Shot& shot, const Exactness& exactness) {
  stage_.set_law(Law::ours);
  const auto rows = stage_.rows_seen_from(shot.view.eye);
  foliage::TreesSeen seen{stage_.sites(), rows, runs, exactness.error_px / shot.focal_px};
  if (far_) {
    words_.resize(seen.sites.size());
    split_trees(*far_, {stage_.table(), seen}, words_.data());
    seen.runs = far_->trees.near;
  }
  const double error = error_for(costs_, stage_.table(), seen,
                                 {.vertices = exactness.vertices, .room = foliage::room_of(stage_.capacity())});
  return {.error_px = error * shot.focal_px,
          .sampling = Sampling::product,
          .far_error_px = exactness.error_px,
          .far = far()};
}

void Ground::draw_frame(const Shot& shot, const Exactness& exactness) {
  const Runs all = in_view(shot);
  stage_.draw_only(all, shot, how_drawn(all, shot, exactness));
}

void Ground::make_wanted(const Shot& shot, const Exactness& exactness) {
  if (!far_) return;
  do draw_frame(shot, exactness);
  while (foliage_benchmark::make_wanted(*far_));
}

Picture Ground::draw(const Shot& shot, const Exactness& exactness, Sampling sampling) {
  make_wanted(shot, exactness);
  const Runs all = in_view(shot);
  HowDrawn how = how_drawn(all, shot, exactness);
  how.sampling = sampling;
  return stage_.draw(all, shot, how);
}

double Ground::overdraw(const Shot& shot, const Exactness& exactness) {
  double samples = 0;
  for (const Vec4& texel : draw(shot, exactness, Sampling::product).texels)
    samples += kProductSamples * static_cast<double>(texel.w);
  const Runs all = in_view(shot);
  return static_cast<double>(stage_.samples_drawn(all, shot, how_drawn(all, shot, exactness))) / std::max(samples, 1.0);
}

HowDrawn Ground::show(const Shot& shot, const Exactness& exactness, TimeRow& row) {
  row.covered_px = static_cast<double>(covered(draw(shot, exactness, Sampling::product)));
  set_shown(stage_.shown(), row);
  if (far_) *row.primitives += primitives_of(*far_);
  const Runs all = in_view(shot);
  const HowDrawn how = how_drawn(all, shot, exactness);
  row.error_px = how.error_px;
  row.trees = trees_of(all);
  row.reference_primitives = full_primitives(stage_, all);
  return how;
}

void Ground::measure(const Shot& shot, const Exactness& exactness, double seconds, TimeRow& row) {
  const HowDrawn how = show(shot, exactness, row);
  time(shot, how, in_view(shot), seconds, row);
}

double Ground::least_ms(const Shot& shot, const Exactness& exactness, int times) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < times; ++i) {
    const auto start = apps::Clock::now();
    draw_frame(shot, exactness);
    least = std::min(least, apps::us_since(start) / 1000);
  }
  return least;
}

void Ground::look(const Shot& shot, const Exactness& exactness, int times, TimeRow& row) {
  show(shot, exactness, row);
  row.ms = least_ms(shot, exactness, times);
}

void Ground::time(const Shot& shot, const HowDrawn& how, const Runs& all, double seconds, TimeRow& row) {
  const auto primitives = static_cast<double>(full_primitives(stage_, all));
  const auto every = static_cast<std::uint32_t>(std::max(1.0, std::ceil(primitives / 2 / most_full_quads_)));
  const Runs some = in_view(shot, every);
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

void Ground::fly(std::span<const Shot> path, const Exactness& exactness, int times, TimeRow& row) {
  std::vector<double> frames_ms, errors_px;
  for (const Shot& shot : path) {
    make_wanted(shot, exactness);
    frames_ms.push_back(least_ms(shot, exactness, times));
    errors_px.push_back(how_drawn(in_view(shot), shot, exactness).error_px);
  }
  row.ms = apps::quantile(frames_ms, 0.5);
  row.ms_99 = apps::quantile(frames_ms, 0.99);
  row.error_px = apps::quantile(errors_px, 0.5);
  row.trees = stage_.sites().size();
}

}  // namespace manzana::foliage_benchmark

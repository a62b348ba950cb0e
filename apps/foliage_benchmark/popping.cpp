#include "apps/foliage_benchmark/popping.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/common/child.h"
#include "apps/common/markdown.h"
#include "apps/foliage_benchmark/errors.h"
#include "apps/foliage_benchmark/fixed_detail.h"
#include "apps/foliage_benchmark/sheet.h"

namespace manzana::foliage_benchmark {
namespace {

using foliage::Law;

constexpr const char* kError = "error";
constexpr const char* kCamera = "camera";
constexpr double kStep = 1.01, kAzimuth = 0.4, kElevation = 0.15;

Step less(const Step& a, const Step& b) {
  return {std::max(0.0, a.mean - b.mean), std::max(0.0, a.strong - b.strong), std::max(0.0, a.most - b.most)};
}

Step worse(const Step& a, const Step& b) {
  return {std::max(a.mean, b.mean), std::max(a.strong, b.strong), std::max(a.most, b.most)};
}

/// Before, after, and their difference on grey.
Picture side_by_side(const Picture& before, const Picture& after) {
  Picture difference = make_picture(before.width, before.height);
  for (std::size_t i = 0; i < before.texels.size(); ++i)
    difference.texels[i] = Vec4(0.5F * (seen_at(after.texels[i]) - seen_at(before.texels[i])) + 0.3F, 1);
  return beside(std::array{before, after, difference});
}

/// Frames of one way, one after the other: what changed most.
class Film {
 public:
  void add(Picture picture, const Step& of_reference) {
    if (before_.width > 0) {
      const Step step = less(step_between(before_, picture), of_reference);
      if (step.mean >= worst_.mean) sheet_ = side_by_side(before_, picture);
      worst_ = worse(worst_, step);
    }
    before_ = std::move(picture);
  }
  const Step& worst() const { return worst_; }
  const Picture& sheet() const { return sheet_; }

 private:
  Picture before_, sheet_;
  Step worst_;
};

class Popping {
 public:
  Popping(Stage& stage, const PopPlan& plan, std::uint32_t plant)
      : stage_(stage), plan_(plan), plant_(plant), extent_(extent_of(stage.plants()[plant])) {}

  PopRow key(const char* moving, double height_px) const {
    PopRow row;
    row.plant = stage_.plants()[plant_].name;
    row.moving = moving;
    row.height_px = height_px;
    return row;
  }

  Popped measure(const PopRow& key) {
    apps::throw_if_interrupted();
    return key.moving == kError ? error_steps(key.height_px) : camera_comes_nearer(key.height_px);
  }

 private:
  Popped error_steps(double height_px) {
    begin(kError, height_px);
    const Shot shot = shot_of(extent_, kAzimuth, kElevation, height_px);
    for (double f = 1 / plan_.range; f < plan_.range; f *= kStep) add_frame(shot, plan_.error_px * f, {});
    return finished();
  }

  Popped camera_comes_nearer(double height_px) {
    begin(kCamera, height_px);
    Picture before;
    for (const Shot& shot : approach(extent_, height_px, plan_.range)) {
      stage_.set_law(Law::full);
      Picture reference = draw(shot, plan_.error_px);
      add_frame(shot, plan_.error_px, before.width > 0 ? step_between(before, reference) : Step{});
      before = std::move(reference);
    }
    return finished();
  }

  void begin(const char* moving, double height_px) {
    row_ = key(moving, height_px);
    faded_ = unfaded_ = {};
  }

  Picture draw(const Shot& shot, double error_px) {
    return stage_.draw({plant_, plant_ + 1}, shot, {error_px, Sampling::product});
  }

  Picture draw_changed(const Shot& shot, double error_px, Detail (*change)(Detail)) {
    stage_.set_law(Law::ours);
    if (change != nullptr) {
      const Detail detail = change(detail_in(shot, error_px));
      stage_.set_details(same_everywhere(stage_.plants(), [&](const PreparedPlant&) { return detail; }));
    }
    return draw(shot, error_px);
  }

  Detail detail_in(const Shot& shot, double error_px) const {
    const Vec3d middle(0, 0, static_cast<double>(stage_.plants()[plant_].height_m) / 2);
    const double error_m = error_px / shot.focal_px * glm::length(shot.view.eye - middle);
    return detail_at(stage_.table(), plant_, static_cast<float>(error_m * error_m) * stage_.sites()[plant_].inv_scale2);
  }

  void add_frame(const Shot& shot, double error_px, const Step& of_reference) {
    faded_.add(draw_changed(shot, error_px, plan_.change), of_reference);
    unfaded_.add(draw_changed(shot, error_px, unfaded), of_reference);
    ++row_.frames;
  }

  Popped finished() {
    const Step a = faded_.worst(), b = unfaded_.worst();
    const auto ratio = [](double x, double y) { return x == y ? 1 : x / std::max(y, 1e-3); };
    row_.most = a.most, row_.strong = a.strong, row_.mean = a.mean;
    row_.unfaded_most = b.most, row_.unfaded_strong = b.strong, row_.unfaded_mean = b.mean;
    row_.ratio_most = ratio(a.most, b.most);
    row_.ratio_strong = ratio(a.strong, b.strong);
    row_.ratio_mean = ratio(a.mean, b.mean);
    return {row_, below(std::array{faded_.sheet(), unfaded_.sheet()})};
  }

  Stage& stage_;
  const PopPlan& plan_;
  std::uint32_t plant_;
  Extent extent_;
  PopRow row_;
  Film faded_, unfaded_;
};

bool same_key(const PopRow& a, const PopRow& b) {
  return a.plant == b.plant && a.moving == b.moving && a.height_px == b.height_px;
}

using C = apps::Column<PopRow>;
const std::vector<C> kOwnColumns{
    C{"plant", "", "", &PopRow::plant},
    C{"moving", "", "error: the camera is frozen; camera: it comes nearer", &PopRow::moving},
    C{"height_px", "pixels", "of the plant, in the middle of an approach", &PopRow::height_px},
    C{"frames", "", "each 1 % from the one before", &PopRow::frames},
    C{"most", "of sRGB", "largest step of a pixel from frame to frame, less the reference's", &PopRow::most},
    C{"strong", "of sRGB", "the same of the 99.9th percentile of pixels", &PopRow::strong},
    C{"mean", "of sRGB", "the same of all pixels", &PopRow::mean},
    C{"unfaded_most", "of sRGB", "without fading", &PopRow::unfaded_most},
    C{"unfaded_strong", "of sRGB", "without fading", &PopRow::unfaded_strong},
    C{"unfaded_mean", "of sRGB", "without fading", &PopRow::unfaded_mean},
    C{"ratio_most", "", "faded over unfaded", &PopRow::ratio_most},
    C{"ratio_strong", "", "faded over unfaded", &PopRow::ratio_strong},
    C{"ratio_mean", "", "faded over unfaded", &PopRow::ratio_mean}};

}  // namespace

std::vector<Shot> approach(const Extent& extent, double height_px, double range) {
  const Shot nearest = shot_of(extent, kAzimuth, kElevation, height_px * range);
  const Vec3d middle(0, 0, (extent.low + extent.high) / 2);
  std::vector<Shot> shots;
  for (double f = range; f > 1 / range; f /= kStep) {
    shots.push_back(nearest);
    shots.back().view.eye = middle + f * range * (nearest.view.eye - middle);
  }
  return shots;
}

std::vector<PopRow> measure_popping(std::span<const foliage::PreparedPlant> plants, const PopPlan& plan,
                                    const std::function<void(double)>& progress,
                                    const std::function<void(const Popped&)>& show, apps::Record<PopRow>* record) {
  Stage stage(plants, sites_of(plants));
  std::vector<PopRow> rows;
  const auto all = static_cast<double>(2 * plants.size() * plan.heights.size());
  const auto add = [&](Popping& popping, const PopRow& key) {
    progress(static_cast<double>(rows.size()) / all);
    const PopRow* known = record == nullptr ? nullptr : record->find([&](const PopRow& r) { return same_key(r, key); });
    if (known != nullptr) {
      rows.push_back(*known);
      return;
    }
    Popped popped = popping.measure(key);
    static_cast<apps::RunFacts&>(popped.row) = apps::run_facts(plan.mode);
    if (show) show(popped);
    if (record != nullptr) record->keep(popped.row);
    rows.push_back(popped.row);
  };
  for (std::uint32_t plant = 0; plant < plants.size(); ++plant) {
    Popping popping(stage, plan, plant);
    for (const double height_px : plan.heights)
      for (const char* moving : {kError, kCamera}) add(popping, popping.key(moving, height_px));
  }
  return rows;
}

std::span<const C> pop_columns() {
  static const auto columns = apps::joined<PopRow>({apps::run_columns<PopRow>(), kOwnColumns});
  return columns;
}

std::string popping_md(std::span<const PopRow> rows) {
  using apps::digits3;
  std::vector<std::vector<std::string>> cells{{"plant", "moving", "height px", "frames", "99.9 % of pixels", "unfaded",
                                               "ratio", "largest", "unfaded ", "ratio ", "mean", " unfaded", " ratio"}};
  std::array<std::size_t, 3> under{};
  for (const PopRow& r : rows) {
    cells.push_back({r.plant, r.moving, digits3(r.height_px), std::to_string(r.frames), digits3(r.strong),
                     digits3(r.unfaded_strong), digits3(r.ratio_strong), digits3(r.most), digits3(r.unfaded_most),
                     digits3(r.ratio_most), digits3(r.mean), digits3(r.unfaded_mean), digits3(r.ratio_mean)});
    const std::array ratios{r.ratio_strong, r.ratio_most, r.ratio_mean};
    for (std::size_t i = 0; i < ratios.size(); ++i) under[i] += ratios[i] <= kMostPopping ? 1 : 0;
  }
  const auto of_all = [&](std::size_t i) { return std::to_string(under[i]) + " of " + std::to_string(rows.size()); };
  return "## Popping\n\nThe worst step from one frame to the next, of sRGB from 0 to 1, as the product samples: with "
         "the "
         "camera frozen and the error stepped by 1 %, and as the camera comes nearer by 1 % a frame, less what all "
         "detail changes meanwhile. Unfaded: leaves end at once, quads turn to points at once, and levels of branches "
         "and points switch at once. Meant: a ratio of at most " +
         digits3(kMostPopping) + "; it is so in " + of_all(0) + " rows for the 99.9th percentile of pixels, in " +
         of_all(1) + " for the largest, in " + of_all(2) + " for the mean.\n\n" + apps::md_table(cells);
}

}  // namespace manzana::foliage_benchmark

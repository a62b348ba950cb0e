#include "foliage/point_fit.h"

#include "foliage/laws.h"
#include "foliage/root.h"
#include "foliage/silhouettes.h"

namespace manzana::foliage {
namespace {

// How steeply views look down, by turns (Silhouettes). Points are seen from far away, so from higher than leaves are.
constexpr std::array kRises{0.03, 0.36, 1.0};

// Somewhere: all is shown as is told.
constexpr std::array<Vec4, 3> kRows{Vec4{1, 0, 0, 0}, {0, 1, 0, 1000}, {0, 0, 1, 0}};
constexpr std::array<Run, 1> kAll{{{0, Silhouettes::kViews}}};

class PointFit {
 public:
  explicit PointFit(PreparedPlant& plant)
      : plant_(plant),
        pictures_(plant, kRises),
        full_(covered(pictures_.coverage(1, 1))),
        m_(measure_for_laws(plant)),
        table_(make_plant_table(std::span(&plant, 1))) {
    for (std::uint64_t id = 0; id < Silhouettes::kViews; ++id)  // edges of trees differ
      sites_.push_back(make_site(plant, 0, plant.height_m, plant.crown_radius_m, 0, id));
  }

  void fit_area(std::size_t level) {
    PointLevel& of = plant_.point_levels[level];
    Detail d = points_alone(of.points.size());
    d.points = static_cast<float>(of.points.size());
    d.point_level = static_cast<float>(level);
    d.point_gain = 1 / d.points;
    const float factor = gain(d, 0.125F, 8);
    of.area *= factor;
    for (std::uint32_t p = of.points.first; p < of.points.last; ++p) plant_.points[p].area *= factor;
  }

  void fit_between(std::size_t level) {
    const double fine = plant_.point_levels[level].points.size(), coarse = plant_.point_levels[level + 1].points.size();
    for (std::size_t i = 0; i < kQuarters.size(); ++i)
      plant_.point_levels[level].between[i] = gain(points_alone(std::lerp(fine, coarse, kQuarters[i])), 0.5F, 2);
  }

  void fit_turning() {
    if (!(m_.quad_m > 0) || m_.thin.width_m > 0) return;
    for (std::size_t i = 0; i < kQuarters.size(); ++i) turning_[i] = gain(turned(kQuarters[i]), 0.5F, 2);
    plant_.turning = turning_;
  }

 private:
  static constexpr std::array kQuarters{0.25, 0.5, 0.75};

  Detail points_alone(double points) const {
    Detail d = show_ours(plant_, m_, error_of_points(plant_, points));
    d.to_points = 1;
    return d;
  }

  /// Where points are so much of the leaves.
  Detail turned(double share) const {
    double near = m_.quad_m / 8, far = error_of_points(plant_, 1e-2);
    for (int round = 0; round < 40; ++round) {
      const double middle = std::sqrt(near * far);
      (static_cast<double>(show_ours(plant_, m_, middle).to_points) < share ? near : far) = middle;
    }
    return show_ours(plant_, m_, far);
  }

  float gain(Detail detail, float least, float most) {
    const float whole = detail.point_gain;
    return root(least, most, [&](float f) {
      detail.point_gain = whole * f;
      table_.details.assign(glsl::kDetailSteps, detail);
      select(table_, {sites_, kRows, kAll, 1}, chosen_);
      return covered(pictures_.coverage(chosen_)) / full_ - 1;
    });
  }

  PreparedPlant& plant_;
  Silhouettes pictures_;
  double full_;
  LawMeasures m_;
  PlantTable table_;
  std::vector<TreeSite> sites_;
  Selection chosen_;
  std::array<float, 3> turning_{1, 1, 1};
};

}  // namespace

void fit_points(PreparedPlant& plant, const Progress& progress) {
  if (plant.leaves.empty()) return;
  PointFit fit(plant);
  const std::size_t levels = plant.point_levels.size();
  for (std::size_t level = 0; level < levels; ++level) {
    fit.fit_area(level);
    tell(progress, level + 1, 2 * levels);
  }
  for (std::size_t level = 0; level + 1 < levels; ++level) {
    fit.fit_between(level);
    tell(progress, levels + level + 1, 2 * levels);
  }
  fit.fit_turning();
}

}  // namespace manzana::foliage

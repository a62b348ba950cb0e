#include "apps/foliage_benchmark/errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "apps/common/child.h"

namespace manzana::foliage_benchmark {
namespace {

using foliage::Law;

constexpr std::array kElevationsDeg{2.0, 20.0, 45.0};

/// Of one plant from one side.
struct Camera {
  double azimuth_deg, elevation_deg;
  Shot shot;
};

Camera camera_of(const Extent& extent, int view, int views, double height_px) {
  Camera camera{360.0 * view / views, kElevationsDeg[static_cast<std::size_t>(view) % kElevationsDeg.size()], {}};
  constexpr double kDegree = std::numbers::pi / 180;
  camera.shot = shot_of(extent, camera.azimuth_deg * kDegree, camera.elevation_deg * kDegree, height_px);
  return camera;
}

void set_errors(const ImageError& error, ErrorRow& row) {
  row.cover = error.cover;
  row.iou = error.iou;
  row.silhouette = error.silhouette;
  row.colour = error.colour;
  row.ssim = error.ssim;
  row.gmsd = error.gmsd;
  row.psnr = error.psnr;
}

void set_counts(const foliage::Shown& shown, ErrorRow& row) {
  row.bark = shown.bark;
  row.leaves = shown.leaves;
  row.lines = shown.lines;
  row.points = shown.points;
  row.primitives = primitives_of(shown);
}

class Measurement {
 public:
  Measurement(Stage& stage, const ErrorPlan& plan, apps::Record<ErrorRow>* record, std::vector<ErrorRow>& rows)
      : stage_(stage), plan_(plan), record_(record), rows_(rows) {}

  /// Another copy from each side, since each has thresholds of its own.
  void add(std::uint32_t plant, const Camera& camera, int view, double height_px) {
    begin(plant, camera, height_px);
    const auto site = plant * static_cast<std::uint32_t>(plan_.views) + static_cast<std::uint32_t>(view);
    if (record_ == nullptr || !take_known()) measure({site, site + 1}, camera);
  }

 private:
  void begin(std::uint32_t plant, const Camera& camera, double height_px) {
    row_.plant = stage_.plants()[plant].name;
    row_.height_px = height_px;
    row_.azimuth_deg = camera.azimuth_deg;
    row_.elevation_deg = camera.elevation_deg;
  }

  bool of_this_picture(const ErrorRow& r) const {
    const auto near = [](double a, double b) { return std::abs(a - b) < 1e-3; };
    return r.plant == row_.plant && r.height_px == row_.height_px && near(r.azimuth_deg, row_.azimuth_deg) &&
           near(r.elevation_deg, row_.elevation_deg) && (r.law == "full" || near(r.error_px, plan_.error_px));
  }

  bool take_known() {
    std::vector<ErrorRow> known;
    for (const ErrorRow& r : record_->rows())
      if (of_this_picture(r)) known.push_back(r);
    if (known.size() != 2 + 2 * plan_.laws.size()) return false;
    rows_.insert(rows_.end(), known.begin(), known.end());
    return true;
  }

  void measure(const foliage::Run& run, const Camera& camera) {
    apps::throw_if_interrupted();
    if (record_ != nullptr) record_->drop([&](const ErrorRow& r) { return of_this_picture(r); });
    stage_.set_law(Law::full);
    const Picture reference = stage_.draw(run, camera.shot, {plan_.error_px, Sampling::fine});
    compare(reference, run, Law::full, moved(camera.shot, 0.5), Sampling::fine, "moved");
    compare(reference, run, Law::full, camera.shot, Sampling::product, "product");
    for (const Law law : plan_.laws) {
      compare(reference, run, law, camera.shot, Sampling::fine, "fine");
      compare(reference, run, law, camera.shot, Sampling::product, "product");
    }
  }

  void compare(const Picture& reference, const foliage::Run& run, Law law, const Shot& shot, Sampling sampling,
               const char* name) {
    stage_.set_law(law);
    const Picture picture = stage_.draw(run, shot, {plan_.error_px, sampling});
    ErrorRow row = row_;
    static_cast<apps::RunFacts&>(row) = apps::run_facts(plan_.mode);
    row.law = name_of(law);
    row.sampling = name;
    row.error_px = law == Law::full ? 0 : plan_.error_px;
    set_counts(stage_.shown(), row);
    set_errors(image_error(reference, picture), row);
    if (record_ != nullptr) record_->keep(row);
    rows_.push_back(std::move(row));
  }

  Stage& stage_;
  const ErrorPlan& plan_;
  apps::Record<ErrorRow>* record_;
  std::vector<ErrorRow>& rows_;
  ErrorRow row_;
};

constexpr std::array kMeasured{&ErrorRow::cover, &ErrorRow::iou,  &ErrorRow::silhouette, &ErrorRow::colour,
                               &ErrorRow::ssim,  &ErrorRow::gmsd, &ErrorRow::psnr};
constexpr std::array kCounted{&ErrorRow::bark, &ErrorRow::leaves, &ErrorRow::lines, &ErrorRow::points,
                              &ErrorRow::primitives};

bool same_kind(const ErrorRow& a, const ErrorRow& b) {
  return a.plant == b.plant && a.height_px == b.height_px && a.law == b.law && a.sampling == b.sampling &&
         a.error_px == b.error_px;
}

bool same_place(const ErrorRow& a, const ErrorRow& b) { return a.plant == b.plant && a.height_px == b.height_px; }

ErrorRow mean_of(std::span<const ErrorRow> rows, const ErrorRow& kind) {
  ErrorRow mean = kind;
  std::vector<const ErrorRow*> alike;
  for (const ErrorRow& row : rows)
    if (same_kind(row, kind)) alike.push_back(&row);
  const auto n = static_cast<double>(alike.size());
  for (const auto member : kMeasured) {
    double sum = 0;
    for (const ErrorRow* row : alike) sum += row->*member;
    mean.*member = sum / n;
  }
  for (const auto member : kCounted) {
    double sum = 0;
    for (const ErrorRow* row : alike) sum += static_cast<double>(row->*member);
    mean.*member = static_cast<std::uint64_t>(std::llround(sum / n));
  }
  return mean;
}

std::string over_floors(const Verdict& v) {
  std::string over;
  if (std::abs(v.cover - 1) > kCoverWithin) over += " cover";
  if (v.colour > kColourWithin) over += " colour";
  if (v.ssim < v.floor_ssim) over += " ssim";
  if (v.gmsd > v.floor_gmsd) over += " gmsd";
  return over.empty() ? over : over.substr(1);
}

}  // namespace

std::vector<foliage::TreeSite> sites_of(std::span<const foliage::PreparedPlant> plants, std::uint32_t copies) {
  std::vector<foliage::TreeSite> sites;
  for (std::uint32_t i = 0; i < copies * plants.size(); ++i) {
    const foliage::PreparedPlant& plant = plants[i / copies];
    sites.push_back(make_site(plant, i / copies, plant.height_m, plant.crown_radius_m, 0, i));
    sites.back().hash = (sites.back().hash & ~255U) | 128U;  // the same tint for all
  }
  return sites;
}

std::vector<ErrorRow> measure_errors(std::span<const foliage::PreparedPlant> plants, const ErrorPlan& plan,
                                     const std::function<void(double)>& progress, apps::Record<ErrorRow>* record) {
  std::vector<ErrorRow> rows;
  Stage stage(plants, sites_of(plants, static_cast<std::uint32_t>(plan.views)));
  Measurement measurement(stage, plan, record, rows);
  const double all = static_cast<double>(plants.size() * plan.heights.size()) * plan.views;
  double done = 0;
  for (std::uint32_t plant = 0; plant < plants.size(); ++plant) {
    const Extent extent = extent_of(plants[plant]);
    for (const double height_px : plan.heights) {
      for (int view = 0; view < plan.views; ++view) {
        measurement.add(plant, camera_of(extent, view, plan.views, height_px), view, height_px);
        progress(++done / all);
      }
    }
  }
  return rows;
}

std::vector<Verdict> judge(std::span<const ErrorRow> rows) {
  std::vector<Verdict> verdicts;
  for (const ErrorRow& row : rows) {
    const auto known = [&](const Verdict& v) { return same_kind(v, row); };
    if (std::none_of(verdicts.begin(), verdicts.end(), known)) verdicts.push_back({mean_of(rows, row), 1, 0, {}});
  }
  for (Verdict& v : verdicts) {
    for (const Verdict& floor : verdicts) {
      if (floor.law != "full" || !same_place(v, floor)) continue;
      v.floor_ssim = std::min(v.floor_ssim, floor.ssim);
      v.floor_gmsd = std::max(v.floor_gmsd, floor.gmsd);
    }
    v.over = over_floors(v);
  }
  return verdicts;
}

}  // namespace manzana::foliage_benchmark

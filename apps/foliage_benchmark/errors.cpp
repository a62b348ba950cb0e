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

Sight sight_of(const Extent& extent, const foliage::Run& run, int view, int views, double height_px) {
  Sight sight;
  sight.runs = {run};
  sight.azimuth_deg = 360.0 * view / views;
  sight.elevation_deg = kElevationsDeg[static_cast<std::size_t>(view) % kElevationsDeg.size()];
  constexpr double kDegree = std::numbers::pi / 180;
  sight.shot = shot_of(extent, sight.azimuth_deg * kDegree, sight.elevation_deg * kDegree, height_px);
  return sight;
}

class Measurement {
 public:
  Measurement(Stage& stage, Lazy<FarSide>* far, const ErrorPlan& plan, apps::Record<ErrorRow>* record,
              std::vector<ErrorRow>& rows)
      : stage_(stage), far_(far), plan_(plan), record_(record), rows_(rows) {}

  void add(const Motif& motif, const Sight& sight) {
    row_.plant = motif.name;
    row_.height_px = motif.height_px;
    row_.azimuth_deg = sight.azimuth_deg;
    row_.elevation_deg = sight.elevation_deg;
    if (record_ == nullptr || !take_known()) measure(sight);
  }

 private:
  bool of_this_picture(const ErrorRow& r) const {
    const auto near = [](double a, double b) { return std::abs(a - b) < 1e-3; };
    const auto asked = [&](const Setting& setting) {
      ErrorRow way;
      set_way(setting, way);
      return same_way(way, r);
    };
    return r.plant == row_.plant && r.height_px == row_.height_px && near(r.azimuth_deg, row_.azimuth_deg) &&
           near(r.elevation_deg, row_.elevation_deg) &&
           (r.law == name_of(Law::full) || std::ranges::any_of(plan_.settings, asked));
  }

  bool take_known() {
    std::vector<ErrorRow> known;
    for (const ErrorRow& r : record_->rows())
      if (of_this_picture(r)) known.push_back(r);
    if (known.size() != 3 + (plan_.product ? 2 : 1) * plan_.settings.size()) return false;
    rows_.insert(rows_.end(), known.begin(), known.end());
    return true;
  }

  void measure(const Sight& sight) {
    apps::throw_if_interrupted();
    if (record_ != nullptr) record_->drop([&](const ErrorRow& r) { return of_this_picture(r); });
    const Setting all{Law::full};
    stage_.set_law(all.law);
    const Picture reference = stage_.draw(sight.runs, sight.shot, {all.error_px, Sampling::fine});
    Sight beside = sight;
    beside.shot = moved(sight.shot, 0.5);
    compare(reference, beside, all, Sampling::fine, "moved");
    compare(reference, sight, all, Sampling::product, "product");
    compare(reference, sight, all, Sampling::single, "single");
    for (const Setting& setting : plan_.settings) {
      compare(reference, sight, setting, Sampling::fine, "fine");
      if (plan_.product) compare(reference, sight, setting, Sampling::product, "product");
    }
  }

  void compare(const Picture& reference, const Sight& sight, const Setting& setting, Sampling sampling,
               const char* name) {
    HowDrawn how = with_far(setting, sight, stage_, far_);
    how.sampling = sampling;
    const Picture picture = stage_.draw(sight.runs, sight.shot, how);
    ErrorRow row = row_;
    static_cast<apps::RunFacts&>(row) = apps::run_facts(plan_.mode);
    set_way(setting, row);
    row.sampling = name;
    set_counts(stage_.shown(), row);
    if (how.far != nullptr) row.primitives += primitives_of(*how.far);
    set_errors(image_error(reference, picture), row);
    if (record_ != nullptr) record_->keep(row);
    rows_.push_back(std::move(row));
  }

  Stage& stage_;
  Lazy<FarSide>* far_;
  const ErrorPlan& plan_;
  apps::Record<ErrorRow>* record_;
  std::vector<ErrorRow>& rows_;
  ErrorRow row_;
};

constexpr std::array kMeasured{&ErrorRow::cover, &ErrorRow::iou,  &ErrorRow::silhouette, &ErrorRow::colour,
                               &ErrorRow::ssim,  &ErrorRow::gmsd, &ErrorRow::psnr};
constexpr std::array kCounted{&ErrorRow::bark, &ErrorRow::leaves, &ErrorRow::lines, &ErrorRow::points,
                              &ErrorRow::primitives};

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

bool is_floor(const ErrorRow& row) {
  return row.law == name_of(Law::full) && (row.sampling == "moved" || row.sampling == "product");
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

bool same_way(const ErrorRow& a, const ErrorRow& b) {
  const auto near = [](double x, double y) { return std::abs(x - y) < 1e-3; };  // files have six digits
  return a.law == b.law && near(a.error_px, b.error_px) && near(a.mosaics, b.mosaics) && near(a.groves, b.groves) &&
         near(a.grove_points, b.grove_points);
}

bool same_kind(const ErrorRow& a, const ErrorRow& b) {
  return a.plant == b.plant && a.height_px == b.height_px && a.sampling == b.sampling && same_way(a, b);
}

void set_way(const Setting& setting, ErrorRow& row) {
  row.law = name_of(setting.law);
  row.error_px = setting.law == Law::full ? 0 : setting.error_px;
  row.mosaics = setting.far ? setting.far->mosaics : 0;
  row.groves = setting.far ? setting.far->groves.all : 0;
  row.grove_points = row.groves > 0 ? setting.far->groves.points : 0;
}

std::string way_name(const ErrorRow& row) {
  using apps::to_cell;
  std::string name = row.law + " " + to_cell(row.error_px) + " px";
  if (row.mosaics > 0) name += ", mosaics under " + to_cell(row.mosaics);
  if (row.groves > 0) name += ", groves under " + to_cell(row.groves) + " of " + to_cell(row.grove_points);
  return name;
}

HowDrawn with_far(const Setting& setting, const Sight& sight, Stage& stage, Lazy<FarSide>* far) {
  stage.set_law(setting.law);
  HowDrawn how{.error_px = setting.error_px, .sampling = Sampling::product};
  if (!setting.far) return how;
  how.far = &**far;
  use(**far, *setting.far);
  do stage.extract_only(sight.runs, sight.shot, how);
  while (make_wanted(**far));
  return how;
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

std::vector<foliage::TreeSite> sites_of(std::span<const foliage::PreparedPlant> plants, std::uint32_t copies) {
  std::vector<foliage::TreeSite> sites;
  for (std::uint32_t i = 0; i < copies * plants.size(); ++i) {
    const foliage::PreparedPlant& plant = plants[i / copies];
    sites.push_back(make_site(plant, i / copies, plant.height_m, plant.crown_radius_m, 0, i));
    sites.back().hash = (sites.back().hash & ~255U) | 128U;  // the same tint for all
  }
  return sites;
}

Motif motif_of(const std::string& name, const Extent& extent, const RunOfView& runs, double height_px, int views) {
  Motif motif{name, height_px, {}};
  for (int view = 0; view < views; ++view)
    motif.sights.push_back(sight_of(extent, runs(static_cast<std::uint32_t>(view)), view, views, height_px));
  return motif;
}

std::vector<Motif> motifs_of(std::span<const foliage::PreparedPlant> plants, const ErrorPlan& plan) {
  std::vector<Motif> motifs;
  std::uint32_t first = 0;  // site
  for (const foliage::PreparedPlant& plant : plants) {
    const auto own = [first](std::uint32_t view) { return foliage::Run{first + view, first + view + 1}; };
    for (const double height_px : plan.heights)
      motifs.push_back(motif_of(plant.name, extent_of(plant), own, height_px, plan.views));
    first += static_cast<std::uint32_t>(plan.views);
  }
  return motifs;
}

std::vector<ErrorRow> measure_errors(std::span<const foliage::PreparedPlant> plants, const ErrorPlan& plan,
                                     const std::function<void(double)>& progress, apps::Record<ErrorRow>* record) {
  Stage stage(plants, sites_of(plants, static_cast<std::uint32_t>(plan.views)));
  return measure_errors(stage, motifs_of(plants, plan), plan, progress, record);
}

std::vector<ErrorRow> measure_errors(Stage& stage, std::span<const Motif> motifs, const ErrorPlan& plan,
                                     const std::function<void(double)>& progress, apps::Record<ErrorRow>* record,
                                     Lazy<FarSide>* far) {
  std::vector<ErrorRow> rows;
  Measurement measurement(stage, far, plan, record, rows);
  std::size_t all = 0, done = 0;
  for (const Motif& motif : motifs) all += motif.sights.size();
  for (const Motif& motif : motifs) {
    for (const Sight& sight : motif.sights) {
      measurement.add(motif, sight);
      progress(static_cast<double>(++done) / static_cast<double>(all));
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
      if (!is_floor(floor) || !same_place(v, floor)) continue;
      v.floor_ssim = std::min(v.floor_ssim, floor.ssim);
      v.floor_gmsd = std::max(v.floor_gmsd, floor.gmsd);
    }
    v.over = over_floors(v);
  }
  return verdicts;
}

}  // namespace manzana::foliage_benchmark

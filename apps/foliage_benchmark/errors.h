#pragma once
/// How far each law of detail is from all detail, from far and near, beside what half a pixel of camera motion and the
/// product's own sampling do.
///   std::vector<ErrorRow> rows = measure_errors(plants, {.heights = {64, 16}, .views = 4}, progress);     // or
///   std::vector<ErrorRow> rows = measure_errors(stage, motifs, {.settings = {{Law::ours, 2}}}, progress);
///   std::vector<Verdict> verdicts = judge(rows);
#include <functional>
#include <string>

#include "apps/common/record.h"
#include "apps/common/run_facts.h"
#include "apps/foliage_benchmark/image_error.h"
#include "apps/foliage_benchmark/lazy.h"
#include "apps/foliage_benchmark/stage.h"

namespace manzana::foliage_benchmark {

/// A law of detail, and what it is told may be wrong; small trees as mosaics and groves, or none.
struct Setting {
  foliage::Law law;
  double error_px = 1;
  std::optional<FarKnobs> far = {};
};

struct ErrorPlan {
  std::vector<double> heights{512, 256, 128, 64, 32, 16, 12};  ///< of the plant, pixels
  int views = 8;                                               ///< evenly round it, at elevations in turn
  std::vector<Setting> settings{{foliage::Law::ours}, {foliage::Law::prune}};
  bool product = true;        ///< every way sampled as the product does, too
  std::string mode = "full";  ///< of the run
};

/// What is looked at, from several sides: a plant of that height, or trees of about that height.
struct Sight {
  Shot shot;
  std::vector<foliage::Run> runs;  ///< of the stage's sites
  double azimuth_deg = 0, elevation_deg = 0;
};
struct Motif {
  std::string name;
  double height_px = 0;
  std::vector<Sight> sights;
};
/// What stands round the origin, evenly from all round, at elevations in turn.
using RunOfView = std::function<foliage::Run(std::uint32_t view)>;
Motif motif_of(const std::string& name, const Extent& extent, const RunOfView& runs, double height_px, int views);
/// Each plant alone. Of sites_of(plants, views): another copy from each side, since each has thresholds of its own.
std::vector<Motif> motifs_of(std::span<const foliage::PreparedPlant> plants, const ErrorPlan& plan);

/// One picture against the reference: all detail, finely sampled.
struct ErrorRow : apps::RunFacts {
  std::string plant;
  std::string law;       ///< full, ours, gumbau
  std::string sampling;  ///< fine, product, single; moved: fine, by half a pixel
  double height_px = 0, azimuth_deg = 0, elevation_deg = 0, error_px = 0;
  double mosaics = 0, groves = 0, grove_points = 0;  ///< FarKnobs; 0: none
  std::uint64_t bark = 0, leaves = 0, lines = 0, points = 0, primitives = 0;
  double cover = 1, iou = 1, silhouette = 0, colour = 0, ssim = 1, gmsd = 0, psnr = 99;
};

void set_errors(const ImageError& error, ErrorRow& row);
void set_way(const Setting& setting, ErrorRow& row);
bool same_way(const ErrorRow& a, const ErrorRow& b);
std::string way_name(const ErrorRow& row);  ///< "ours 1 px, mosaics under 24, groves under 10 of 0.7"
void set_counts(const foliage::Shown& shown, ErrorRow& row);

/// Of motifs_of(plants, plan). `progress` is called with [0, 1]. Pictures whose rows the record holds are not drawn
/// again; those that are new are kept there.
std::vector<ErrorRow> measure_errors(std::span<const foliage::PreparedPlant> plants, const ErrorPlan& plan,
                                     const std::function<void(double)>& progress,
                                     apps::Record<ErrorRow>* record = nullptr);

/// `far`: of the stage's sites, for settings that have some.
std::vector<ErrorRow> measure_errors(Stage& stage, std::span<const Motif> motifs, const ErrorPlan& plan,
                                     const std::function<void(double)>& progress,
                                     apps::Record<ErrorRow>* record = nullptr, Lazy<FarSide>* far = nullptr);
/// With the knobs of the setting, and what they want for that sight made.
HowDrawn with_far(const Setting& setting, const Sight& sight, Stage& stage, Lazy<FarSide>* far);

/// Of one plant, height, way and sampling.
bool same_kind(const ErrorRow& a, const ErrorRow& b);

/// The means over the views of one plant, height, way and sampling, and which of them are over the floors.
struct Verdict : ErrorRow {
  double floor_ssim = 1,
         floor_gmsd = 0;  ///< the worse of both floors: all detail moved, and sampled as the product does
  std::string over;       ///< "cover ssim"; empty: nothing is
};
inline constexpr double kCoverWithin = 0.02, kColourWithin = 0.005;

/// A verdict for each way and sampling, floors among them, in the order of the rows.
std::vector<Verdict> judge(std::span<const ErrorRow> rows);

/// Of each plant so many copies, one after the other, at the origin, of natural size and of the same tint.
std::vector<foliage::TreeSite> sites_of(std::span<const foliage::PreparedPlant> plants, std::uint32_t copies = 1);

}  // namespace manzana::foliage_benchmark

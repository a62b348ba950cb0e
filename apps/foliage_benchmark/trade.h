#pragma once
/// Speed for accuracy: each law of detail over the error that it is told may be wrong, on plants near and far and on
/// stands of trees, and the knobs of mosaics and groves on a wood that is far away; how wrong each then is, what it
/// costs, and which of them nothing beats.
///   const TradePlan plan = trade_plan(quick);
///   std::vector<TradePoint> points = trade_points(rows, steps, times);  // of measure_trade(), measure_trade_steps()
///                                                                       // and add_trade_costs()
///   std::vector<Profile> profiles = choose_profiles(points);
#include <optional>
#include <string>

#include "apps/foliage_benchmark/errors.h"
#include "apps/foliage_benchmark/times.h"
#include "apps/foliage_benchmark/trade_steps.h"

namespace manzana::foliage_benchmark {

struct TradePlan {
  ErrorPlan errors;
  std::uint32_t stand_trees = 64;
  int stand_rows = 360;  ///< of the stands' pictures
  ErrorPlan far;         ///< of the wood: heights of its trees, FarKnobs
  std::uint32_t wood_trees = 49;
  std::vector<double> step_heights{64, 16}, wood_step_heights{24, 8};  ///< of what is approached
  double step_range = 1.4;                                             ///< HowApproached::range
};
TradePlan trade_plan(bool quick);

/// A closed stand from its edge, from inside and from above; `sites`: make_stand()'s.
std::vector<foliage::TreeSite> make_stand(std::span<const foliage::PreparedPlant> plants, const TradePlan& plan);
std::vector<Motif> stand_motifs(std::span<const foliage::PreparedPlant> plants, const TradePlan& plan);

/// A block of a closed wood from afar, so that its trees are on average so high; trade_woods.cpp.
std::vector<foliage::TreeSite> make_wood(std::span<const foliage::PreparedPlant> plants, const TradePlan& plan);
Extent extent_of_wood(std::span<const foliage::PreparedPlant> plants, std::span<const foliage::TreeSite> sites);
std::vector<Motif> wood_motifs(std::span<const foliage::PreparedPlant> plants, const TradePlan& plan);
ErrorPlan wood_plan(bool quick);

/// Quads in full.
std::uint64_t bark_of(std::span<const foliage::PreparedPlant> plants, std::span<const foliage::TreeSite> sites);

/// Plants, stands and woods: all pictures of the plan.
std::vector<ErrorRow> measure_trade(std::span<const foliage::PreparedPlant> plants, const TradePlan& plan,
                                    const std::function<void(double)>& progress, apps::Record<ErrorRow>& record);
/// Approaches to each plant, and to the wood, by all ways of the plan.
std::vector<StepRow> measure_trade_steps(std::span<const foliage::PreparedPlant> plants, const TradePlan& plan,
                                         const std::function<void(double)>& progress, apps::Record<StepRow>& record);
inline constexpr const char* kTradeTable = "trade";
/// What each way takes, against all detail: rows of times.csv. Of a height all plants are timed together, each drawn
/// from one side, as often as it has views.
void add_trade_costs(const Effort& effort, std::span<const foliage::PreparedPlant> plants, const TradePlan& plan,
                     Times& times);

/// A way on one plant at one height, or on one stand: means over the views of the finely sampled pictures, which show
/// the model's error alone, and by how much those means may be off (95 %).
struct TradePoint : Verdict {
  std::uint64_t views = 0;
  double cover_within = 0, colour_within = 0, ssim_within = 0, gmsd_within = 0;
  std::optional<double> pop;                        ///< pop_of(), where it was measured; of all plants the worst one's
  double primitives_ratio = 1;                      ///< of all detail's
  std::optional<double> ratio, ratio_lo, ratio_hi;  ///< times as fast as all detail
  std::string front;                                ///< "front": nothing else at that height costs less and errs less
  std::string profiles;                             ///< that use this way: "balanced accurate"
};
/// Of all plants together, too, as of one plant of this name.
inline constexpr const char* kAllPlants = "all plants";
bool is_stand(std::string_view name);  ///< or a wood
inline constexpr const char* kWood = "wood, from afar";
/// What the way's row of times.csv is called, beside the plant.
std::string cost_key(const ErrorRow& way, double height_px);
std::vector<TradePoint> trade_points(std::span<const ErrorRow> rows, std::span<const StepRow> steps,
                                     const Times& times);

/// By how much the worst of the errors, with its 95 %, is over what a profile allows: 1 is the limit. Cover within
/// 0.02, colour 0.005, structure as far from 1 as the floor's is; GMSD the floor's; all of it times `allowed`. Steps
/// from frame to frame may be twice all detail's, whatever is allowed.
double worst_over(const TradePoint& point, double allowed);

/// The cheapest way that errs at most `allowed` times the limits at every height of all plants together.
struct Profile {
  std::string name;
  double allowed = 1;
  std::string law = "full";  ///< all detail, where nothing is within what is allowed
  double error_px = 0;
  std::uint64_t samples = 4;    ///< a pixel: 1 where all detail is then within what is allowed
  double primitives_ratio = 1;  ///< of all detail's: geometric mean over heights
};
std::vector<Profile> choose_profiles(std::vector<TradePoint>& points);  ///< and notes them in the points

}  // namespace manzana::foliage_benchmark

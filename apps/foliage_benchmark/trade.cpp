#include "apps/foliage_benchmark/trade.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "apps/common/markdown.h"
#include "apps/foliage_benchmark/forest.h"

namespace manzana::foliage_benchmark {
namespace {

using foliage::Law;
using foliage::PreparedPlant;

constexpr std::array kLaws{Law::ours, Law::prune, Law::ramp, Law::points_and_lines, Law::levels};

std::vector<Setting> settings_of(bool quick) {
  std::vector<double> ours{0.25, 0.35, 0.5, 0.85, 1, 1.4, 2, 4}, others{1};
  if (!quick) ours = {0.25, 0.35, 0.5, 0.7, 0.85, 1, 1.2, 1.4, 2, 2.8, 4, 8}, others = {0.5, 1, 2, 4};
  std::vector<Setting> settings;
  for (const Law law : kLaws)
    for (const double error : law == Law::ours ? ours : others) settings.push_back({law, error});
  return settings;
}

double half_side(std::span<const PreparedPlant> plants, const TradePlan& plan) {
  return closed_spacing(plants) * std::sqrt(plan.stand_trees) / 2;
}

/// Where the eye is, in halves of the stand's side and heights of its trees, and how far it looks down.
struct Eye {
  const char* name;
  double away, up, down;
};
constexpr std::array<Eye, 3> kEyes{
    {{"stand, its edge", 2.2, 0.1, 0.0}, {"stand, inside", 0.2, 0.1, -0.2}, {"stand, above", 2.2, 5, 0.9}}};

/// The first side, with the trees of all.
Sight all_of(const Motif& motif) {
  Sight sight = motif.sights.front();
  for (const Sight& other : std::span(motif.sights).subspan(1))
    sight.runs.insert(sight.runs.end(), other.runs.begin(), other.runs.end());
  return sight;
}

/// What is drawn and timed together.
struct Costed {
  std::string name;
  double height_px;
  std::vector<Sight> sights;
};

/// All plants of a height, one after the other.
std::vector<Costed> all_together(std::span<const Motif> motifs) {
  std::vector<Costed> all;
  for (const Motif& motif : motifs) {
    auto at = std::ranges::find(all, motif.height_px, &Costed::height_px);
    if (at == all.end()) at = all.insert(all.end(), {kAllPlants, motif.height_px, {}});
    at->sights.push_back(all_of(motif));
  }
  return all;
}

std::vector<Costed> one_by_one(std::span<const Motif> motifs) {
  std::vector<Costed> all;
  for (const Motif& motif : motifs) all.push_back({motif.name, motif.height_px, {motif.sights.front()}});
  return all;
}

struct Place {
  Lazy<Stage>& stage;
  Lazy<FarSide>* far = nullptr;
};

void measure_cost(const Costed& costed, const Setting& setting, const Place& place, double seconds, TimeRow& row) {
  Stage& stage = *place.stage;
  std::vector<HowDrawn> how;
  for (const Sight& sight : costed.sights) how.push_back(with_far(setting, sight, stage, place.far));
  const auto way = [&] {
    stage.set_law(setting.law);
    for (std::size_t i = 0; i < how.size(); ++i) stage.draw_only(costed.sights[i].runs, costed.sights[i].shot, how[i]);
  };
  const auto all_detail = [&] {
    stage.set_law(Law::full);
    for (const Sight& sight : costed.sights) stage.draw_only(sight.runs, sight.shot, {.sampling = Sampling::product});
  };
  row.error_px = setting.error_px;
  row.trees = 0;
  for (const Sight& sight : costed.sights) row.trees += trees_of(sight.runs);
  set_times(time_pairs(way, all_detail, seconds, 1), row);
}

void add_costs(const Effort& effort, const std::vector<Costed>& all, std::span<const Setting> settings,
               const Place& place, Times& times) {
  for (const Costed& costed : all)
    for (const Setting& setting : settings) {
      ErrorRow way;
      set_way(setting, way);
      times.add({.table = kTradeTable,
                 .plant = costed.name,
                 .way = cost_key(way, costed.height_px),
                 .reference = "all detail"},
                [&](TimeRow& row) { measure_cost(costed, setting, place, effort.seconds() / 5, row); });
    }
}

}  // namespace

std::string cost_key(const ErrorRow& way, double height_px) {
  return way_name(way) + ", " + apps::digits3(height_px) + " px high";
}

TradePlan trade_plan(bool quick) {
  TradePlan plan;
  plan.errors.settings = settings_of(quick);
  plan.errors.mode = quick ? "quick" : "full";
  plan.errors.heights = {256, 128, 64, 32, 16, 12};
  plan.errors.product = false;
  plan.far = wood_plan(quick);
  if (!quick) return plan;
  plan.wood_trees = 16;
  plan.step_heights = plan.wood_step_heights = {24};
  plan.step_range = 1.2;
  plan.errors.heights = {96, 24};
  plan.errors.views = 3;
  plan.stand_trees = 16;
  plan.stand_rows = 120;
  return plan;
}

std::vector<foliage::TreeSite> make_stand(std::span<const PreparedPlant> plants, const TradePlan& plan) {
  return make_forest(plants, plan.stand_trees, closed_spacing(plants), 5);
}

std::uint64_t bark_of(std::span<const PreparedPlant> plants, std::span<const foliage::TreeSite> sites) {
  std::uint64_t quads = 0;
  for (const foliage::TreeSite& site : sites) {
    const PreparedPlant& plant = plants[site.plant];
    quads += plant.branch_levels.empty() ? 0 : plant.branch_levels.front().quads.size();
  }
  return quads;
}

std::vector<Motif> stand_motifs(std::span<const PreparedPlant> plants, const TradePlan& plan) {
  const double half = half_side(plants, plan), height = static_cast<double>(plants.front().height_m);
  std::vector<Motif> motifs;
  for (const Eye& from : kEyes) {
    Motif motif{from.name, 0, {}};
    for (int view = 0; view < plan.errors.views; ++view) {
      const double azimuth = 2 * std::numbers::pi * view / plan.errors.views;
      const Vec3d out(std::cos(azimuth), std::sin(azimuth), 0);
      const Vec3d eye = out * (from.away * half) + Vec3d(0, 0, from.up * height);
      Sight sight{screen_shot(eye, -out - Vec3d(0, 0, from.down), plan.stand_rows), {{0, plan.stand_trees}}, 0, 0};
      sight.azimuth_deg = 360.0 * view / plan.errors.views;
      motif.height_px = std::round(sight.shot.focal_px * height / std::max(glm::length(eye), half));
      sight.shot.fine = fine_samples(motif.height_px, sight.shot.width);
      motif.sights.push_back(std::move(sight));
    }
    motifs.push_back(std::move(motif));
  }
  return motifs;
}

std::vector<ErrorRow> measure_trade(std::span<const PreparedPlant> plants, const TradePlan& plan,
                                    const std::function<void(double)>& progress, apps::Record<ErrorRow>& record) {
  constexpr double kPlants = 0.5, kStands = 0.3, kWoods = 0.2;  // of the time
  const auto part = [&](double first, double share) {
    return [=, &progress](double done) { progress(first + share * done); };
  };
  auto rows = measure_errors(plants, plan.errors, part(0, kPlants), &record);
  const auto add = [&](const std::vector<ErrorRow>& more) { rows.insert(rows.end(), more.begin(), more.end()); };
  Stage stand(plants, make_stand(plants, plan)), wood(plants, make_wood(plants, plan));
  add(measure_errors(stand, stand_motifs(plants, plan), plan.errors, part(kPlants, kStands), &record));
  Lazy<FarSide> far([&] { return FarSide(plants, wood.sites()); });
  add(measure_errors(wood, wood_motifs(plants, plan), plan.far, part(kPlants + kStands, kWoods), &record, &far));
  return rows;
}

std::vector<StepRow> measure_trade_steps(std::span<const PreparedPlant> plants, const TradePlan& plan,
                                         const std::function<void(double)>& progress, apps::Record<StepRow>& record) {
  constexpr double kPlants = 0.8;  // of the time
  std::vector<Approached> alone, woods;
  for (std::uint32_t i = 0; i < plants.size(); ++i)
    for (const double height_px : plan.step_heights)
      alone.push_back({plants[i].name, extent_of(plants[i]), {i, i + 1}, height_px});
  const auto sites = make_wood(plants, plan);
  for (const double height_px : plan.wood_step_heights)
    woods.push_back({kWood, extent_of_wood(plants, sites), {0, plan.wood_trees}, height_px});
  Stage stage(plants, sites_of(plants)), wood(plants, sites);
  Lazy<FarSide> far([&] { return FarSide(plants, wood.sites()); });
  HowApproached how{plan.step_range, plan.errors.mode};
  auto rows = measure_steps(
      stage, alone, plan.errors.settings, how, [&](double done) { progress(kPlants * done); }, record);
  how.far = &far;
  const auto more = measure_steps(
      wood, woods, plan.far.settings, how, [&](double done) { progress(kPlants + (1 - kPlants) * done); }, record);
  rows.insert(rows.end(), more.begin(), more.end());
  return rows;
}

void add_trade_costs(const Effort& effort, std::span<const PreparedPlant> plants, const TradePlan& plan, Times& times) {
  const auto copies = static_cast<std::uint32_t>(plan.errors.views);
  Lazy<Stage> alone([&] { return Stage(plants, sites_of(plants, copies)); }),
      stand([&] { return Stage(plants, make_stand(plants, plan)); }),
      wood([&] { return Stage(plants, make_wood(plants, plan)); });
  Lazy<FarSide> far([&] { return FarSide(plants, wood->sites()); });
  add_costs(effort, all_together(motifs_of(plants, plan.errors)), plan.errors.settings, {.stage = alone}, times);
  add_costs(effort, one_by_one(stand_motifs(plants, plan)), plan.errors.settings, {.stage = stand}, times);
  add_costs(effort, one_by_one(wood_motifs(plants, plan)), plan.far.settings, {.stage = wood, .far = &far}, times);
}

}  // namespace manzana::foliage_benchmark

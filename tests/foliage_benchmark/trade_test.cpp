// Speed for accuracy: what is on the front, and which way each profile takes, of rows written by hand.
#include "apps/foliage_benchmark/trade_report.h"

#include <catch2/catch.hpp>

namespace manzana::foliage_benchmark {
namespace {

/// Two views of all detail, which set the floors, and of each way.
class Rows {
 public:
  explicit Rows(std::string plant = "oak", double height = 32) {
    row_.plant = std::move(plant);
    row_.height_px = height;
    for (const char* sampling : {"moved", "product", "single"}) add("full", 0, 1000, {1, 0, 0.8, 0.1}, sampling);
  }
  struct Error {
    double cover, colour, ssim, gmsd;
  };
  void add(const char* law, double error_px, std::uint64_t primitives, const Error& error,
           const char* sampling = "fine") {
    for (int view = 0; view < 2; ++view) {
      ErrorRow row = row_;
      row.law = law, row.error_px = error_px, row.primitives = primitives, row.sampling = sampling;
      row.cover = error.cover, row.colour = error.colour, row.ssim = error.ssim, row.gmsd = error.gmsd;
      rows.push_back(row);
    }
  }
  void set_knobs(const FarKnobs& knobs) { set_way({foliage::Law::ours, 1, knobs}, row_); }
  std::vector<ErrorRow> rows;

 private:
  ErrorRow row_;
};

const TradePoint& point(const std::vector<TradePoint>& points, const std::string& law, double error_px) {
  return *std::ranges::find_if(
      points, [&](const TradePoint& p) { return p.plant == "oak" && p.law == law && p.error_px == error_px; });
}

}  // namespace

TEST_CASE("trade: what costs more and errs no less is not on the front") {
  Rows given;
  given.add("ours", 1, 100, {1.01, 0.001, 0.9, 0.05});
  given.add("ours", 2, 10, {1.03, 0.002, 0.85, 0.08});
  given.add("gumbau", 1, 200, {1.01, 0.001, 0.9, 0.05});
  given.add("gumbau", 2, 200, {1.01, 0.001, 0.95, 0.05});
  const auto points = trade_points(given.rows, {}, {});
  CHECK(point(points, "ours", 1).front == "front");
  CHECK(point(points, "ours", 2).front == "front");
  CHECK(point(points, "gumbau", 1).front.empty());
  CHECK(point(points, "gumbau", 2).front == "front");
  CHECK(point(points, "ours", 2).primitives_ratio == Approx(0.01));
  CHECK(point(points, "ours", 2).views == 2);
  CHECK(worst_over(point(points, "ours", 2), 1) == Approx(1.5));
  CHECK(worst_over(point(points, "ours", 2), 2) == Approx(0.75));
}

TEST_CASE("trade: a profile is the cheapest way that is within what it allows everywhere") {
  Rows near("oak", 128), far("oak", 16);
  for (Rows* rows : {&near, &far}) {
    rows->add("ours", 0.5, 500, {1, 0, 0.95, 0.04});
    rows->add("ours", 1, 100, {1.01, 0.001, 0.9, 0.05});
    rows->add("ours", 4, 5, {1.2, 0.02, 0.5, 0.3});
  }
  near.add("ours", 2, 10, {1.01, 0.001, 0.9, 0.05});
  far.add("ours", 2, 10, {1.03, 0.002, 0.9, 0.05});  // cover
  near.rows.insert(near.rows.end(), far.rows.begin(), far.rows.end());
  auto points = trade_points(near.rows, {}, {});
  const auto profiles = choose_profiles(points);
  REQUIRE(profiles.size() == 3);
  CHECK(profiles[0].error_px == 2);
  CHECK(profiles[1].error_px == 1);
  CHECK(profiles[2].error_px == 0.5);
  CHECK(profiles[1].samples == 1);  // one sample of all detail is as good as the floor here
  CHECK(profiles[2].samples == 8);
  CHECK(profiles[1].primitives_ratio == Approx(0.1));
  CHECK(quality_csv(profiles) ==
        "name,tree_law,tree_error_px,samples\nfast,ours,2,1\nbalanced,ours,1,1\naccurate,ours,0.5,8\n");
  CHECK(point(points, "ours", 1).profiles == "balanced");
}

TEST_CASE("trade: a way that pops is no profile, however true its pictures are") {
  Rows given;
  given.add("ours", 0.5, 500, {1, 0, 0.95, 0.04});
  given.add("ours", 1, 100, {1, 0, 0.95, 0.04});
  given.add("ours", 2, 10, {1, 0, 0.95, 0.04});
  const auto step = [](const char* plant, double error_px, double more) {
    StepRow row;
    row.plant = plant, row.height_px = 32, row.step = more, row.reference_step = 0.02;
    set_way({foliage::Law::ours, error_px}, row);
    return row;
  };
  const auto with = [&](std::vector<StepRow> steps) {
    auto points = trade_points(given.rows, steps, {});
    std::vector<double> errors;
    for (const Profile& profile : choose_profiles(points)) errors.push_back(profile.error_px);
    return errors;
  };
  CHECK(with({}) == std::vector<double>{2, 2, 2});
  CHECK(with({step("oak", 2, 0.021), step("oak", 1, 0.019)}) == std::vector<double>{1, 1, 1});
  CHECK(with({step("oak", 2, 0.021), step("oak", 1, 0.021)}) == std::vector<double>{0.5, 0.5, 0.5});
  CHECK(with({step(kWood, 2, 0.021)}) == std::vector<double>{2, 2, 2});  // is shown, and does not decide
  StepRow elsewhere = step("oak", 2, 0.021);
  elsewhere.height_px = 64;
  CHECK(with({elsewhere}) == std::vector<double>{2, 2, 2});
}

TEST_CASE("trade: ways with other knobs of mosaics and groves are other ways") {
  Rows given("wood, from afar");
  given.add("ours", 1, 900, {1, 0, 0.9, 0.05});
  given.set_knobs({24, {.all = 10, .points = 0.7}});
  given.add("ours", 1, 100, {1, 0.001, 0.9, 0.05});
  given.set_knobs({24, {.all = 10, .points = 1.4}});
  given.add("ours", 1, 200, {1, 0.002, 0.9, 0.05});
  Rows alone;
  alone.add("ours", 1, 100, {1, 0.001, 0.95, 0.04});
  given.rows.insert(given.rows.end(), alone.rows.begin(), alone.rows.end());
  auto points = trade_points(given.rows, {}, {});
  choose_profiles(points);
  std::vector<TradePoint> wood;
  for (const TradePoint& p : points)
    if (p.plant == kWood && p.law == "ours") wood.push_back(p);
  REQUIRE(wood.size() == 3);
  CHECK(wood[0].primitives == 900);
  CHECK(wood[1].primitives == 100);
  CHECK(wood[1].front == "front");
  CHECK(wood[2].front.empty());
  CHECK(wood[0].profiles.empty());
  CHECK(wood[1].profiles == "fast balanced accurate");  // the walkthrough's knobs
  CHECK(way_name(wood[0]) == "ours 1 px");
  CHECK(way_name(wood[2]) == "ours 1 px, mosaics under 24, groves under 10 of 1.4");
  CHECK(cost_key(wood[1], 8) != cost_key(wood[2], 8));
  const auto plots = trade_plots(points);
  const auto plot = std::ranges::find(plots, "pareto_wood_from_afar", &apps::Script::name);
  REQUIRE(plot != plots.end());
  CHECK(plot->text.find("\n1,") == std::string::npos);  // all detail is no way
  CHECK(plot->text.find("title 'beaten'") != std::string::npos);
}

TEST_CASE("trade: where nothing is within what is allowed the profile is all detail") {
  Rows given;
  given.add("ours", 1, 100, {1.5, 0.1, 0.1, 0.5});
  auto points = trade_points(given.rows, {}, {});
  for (const Profile& profile : choose_profiles(points)) CHECK(profile.law == "full");
}

}  // namespace manzana::foliage_benchmark

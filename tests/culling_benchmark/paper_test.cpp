#include "apps/culling_benchmark/paper.h"

#include <array>
#include <catch2/catch.hpp>
#include <set>

#include "apps/culling_benchmark/paper_lanes.h"
#include "culling/baselines/cases.h"
#include "gl/context.h"
#include "gl/error_log.h"

namespace manzana::paper {
namespace {

using Picture = std::vector<unsigned char>;
using Colour = std::array<unsigned char, 3>;

const PaperOptions kSmall{.frames = 9, .parts = 2, .width = 320, .height = 180};

Colour pixel(const Picture& picture, std::size_t i) {
  return {picture.at(3 * i), picture.at(3 * i + 1), picture.at(3 * i + 2)};
}

std::size_t different_pixels(const Picture& a, const Picture& b) {
  REQUIRE(a.size() == b.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.size() / 3; ++i) different += pixel(a, i) != pixel(b, i) ? 1 : 0;
  return different;
}

std::size_t colours(const Picture& picture) {
  std::set<Colour> all;
  for (std::size_t i = 0; i < picture.size() / 3; ++i) all.insert(pixel(picture, i));
  return all.size();
}

/// Each structure that is there, in one of the ways to the device; the product's tree in all.
std::vector<Lane> available_lanes(std::span<const CarLevel> levels, std::uint32_t cars) {
  std::vector<Lane> lanes;
  const auto add = [&](const char* slug, Residency way, Attach attach) {
    lanes.push_back({"C1", slug, way, levels, cars, attach});
  };
  for (const char* slug : {"none", "bqr-paper", "vam-block8", "vam-block6", "vam-block1"}) {
    const auto* info = baselines::find_peer(slug);
    if (info != nullptr && info->available) add(slug, static_cast<Residency>(lanes.size() % 3), Attach::lazy);
  }
  for (const Residency way : {Residency::resent, Residency::cars_resident, Residency::resident})
    add("bqr", way, Attach::eager);
  return lanes;
}

void check_pictures(const std::vector<Lane>& lanes) {
  const gl::HeadlessContext context;
  gl::ErrorLog log;
  Stage stage(kSmall.width, kSmall.height);
  ReadyLanes ready(lanes, kSmall, stage);
  for (const int frame : {0, 2, 4, 6}) {
    Picture all;
    for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
      INFO("frame " << frame << ", " << lanes[lane].peer << ", way " << static_cast<int>(lanes[lane].residency));
      ready.frame(lane, frame);
      const Picture picture = stage.read_pixels();
      if (lane == 0) all = picture;
      CHECK(different_pixels(picture, all) == 0);
      CHECK(colours(picture) > 50);
    }
  }
  for (const std::string& message : log.messages()) FAIL_CHECK(message);
}

}  // namespace

TEST_CASE("every structure, and every way to the device, gives the same picture") {
  check_pictures(available_lanes({}, 0));
}

TEST_CASE("so they do with cars") { check_pictures(available_lanes(kFiveLevels, 400)); }

TEST_CASE("triangles that are drawn are those of what a structure takes") {
  const gl::HeadlessContext context;
  Stage stage(64, 36);
  const baselines::City city = baselines::make_city(*baselines::find_case("C1"), kSmall.seed);
  const std::vector<Lane> lanes = available_lanes({}, 0);
  ReadyLanes ready(lanes, kSmall, stage);
  baselines::Answer answer;
  for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
    const auto peer = baselines::find_peer(lanes[lane].peer)->make(city);
    for (int i = 0; i < kSmall.frames; ++i) {
      const culling::View view = baselines::flight(city, std::numeric_limits<double>::infinity(), i / 8.0);
      peer->query(culling::make_frustum(view), answer);
      std::uint64_t triangles = 0;
      for (const std::uint32_t row : baselines::taken(*peer, answer)) triangles += city.triangles[row];
      INFO(lanes[lane].peer << ", frame " << i);
      CHECK(ready.frame(lane, i).triangles == triangles);
    }
  }
}

TEST_CASE("streets add no triangles to a frame, and each car its own") {
  const gl::HeadlessContext context;
  Stage stage(64, 36);
  const Lane without{.city = "C1", .peer = "none", .levels = kOneLevel}, bare{.city = "C1", .peer = "none"};
  Lane with = without;
  with.cars = 30;
  ReadyLanes ready({without, with, bare}, kSmall, stage);
  CHECK(ready.frame(0, 3).triangles == 367'000);
  CHECK(ready.frame(1, 3).triangles == 367'000 + 30 * 387);
  CHECK(ready.frame(2, 3).triangles == 367'000);
}

TEST_CASE("a run measures each frame once, and stops between parts when its time is over") {
  const gl::HeadlessContext context;
  const std::vector<Lane> lanes{{.city = "C1", .peer = "none", .residency = Residency::resident},
                                {.city = "C1", .peer = "bqr"}};
  double last = -1;
  int parts = 0;
  const Tell tell{[&](double done) {
                    CHECK(done >= last);
                    CHECK(done <= 1);
                    last = done;
                  },
                  [&](const PaperRun& run) { CHECK(run.parts_done == ++parts); }};
  PaperRun whole = unmeasured(lanes, kSmall);
  measure(whole, tell);
  CHECK(whole.parts_done == 2);
  CHECK(parts == 2);
  for (const LaneCosts& lane : whole.lanes)
    for (const FrameCost& frame : lane.frames) CHECK((frame.measured && frame.total_ms() > 0));
  CHECK(whole.lanes[0].city_triangles == 367'000);
  CHECK(last == 1);

  PaperOptions hasty = kSmall;
  hasty.budget_s = 0;
  PaperRun run = unmeasured(lanes, hasty);
  measure(run, {});
  CHECK(run.parts_done == 1);
  for (std::size_t i = 0; i < 9; ++i) CHECK(run.lanes.at(1).frames.at(i).measured == (i % 2 == 0));
}

}  // namespace manzana::paper

#include "apps/culling_benchmark/timing.h"

#include <chrono>
#include <cmath>
#include <numeric>

#include "apps/common/statistics.h"
#include "apps/culling_benchmark/truth.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

using namespace manzana;
using namespace manzana::culling_benchmark;

namespace {

/// Takes a fixed time, and finds all but the objects before `from`.
class Waiting : public baselines::Peer {
 public:
  Waiting(double us, std::uint32_t objects, std::uint32_t from = 0) : us_(us), objects_(objects), from_(from) {}
  void query(const culling::FrustumD&, baselines::Answer& answer) override {
    const auto start = std::chrono::steady_clock::now();
    answer.runs = {{from_, objects_}};
    ++queries;
    while (std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count() < us_) {
    }
  }
  std::size_t bytes() const override { return 0; }
  int queries = 0;

 private:
  double us_;
  std::uint32_t objects_, from_;
};

std::vector<std::size_t> flight_of(std::size_t frames) {
  std::vector<std::size_t> all(frames);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

}  // namespace

TEST_CASE("plan: all if there is time, else fewer frames, then fewer pairs, never under the least") {
  const auto sizes = [&](double seconds, double us, std::size_t frames) {
    const Limits limits{.seconds = seconds, .pairs = 50, .least_pairs = 9, .least_frames = 12};
    const Plan plan = plan_pairs(limits, std::vector(frames, us / 4), std::vector(frames, us / 4), us / 4);
    return std::pair{plan.pairs, plan.frames.size()};
  };
  using Sizes = std::pair<std::size_t, std::size_t>;
  CHECK(sizes(1, 1, 300) == Sizes{50, 300});
  CHECK(sizes(1, 0, 300) == Sizes{50, 300});
  CHECK(sizes(1, 200, 300) == Sizes{50, 100});
  CHECK(sizes(1, 4000, 300) == Sizes{20, 12});
  CHECK(sizes(1, 1e9, 300) == Sizes{9, 12});
  CHECK(sizes(1, 1e9, 3) == Sizes{9, 3});
  CHECK(sizes(-1, 1, 300) == Sizes{9, 12});  // late already
  const std::vector<double> quick(300, 1), slow(300, 1e6);
  CHECK(plan_pairs({.seconds = -1, .least_seconds = 0.05}, quick, quick, 0).frames.size() == 300);
  CHECK(plan_pairs({.seconds = -1, .least_seconds = 0.05}, quick, slow, 0).frames.size() == 12);
}

TEST_CASE("plan: a flight that is cut is flown twice a round and has half the time for what counts") {
  const Limits limits{.seconds = 1, .pairs = 50, .least_pairs = 9, .least_frames = 12};
  const std::vector<double> us(300, 100);
  const Plan cut = plan_pairs(limits, us, us, 0), whole = plan_pairs(limits, {1, 1}, {1, 1}, 0),
             cold = plan_pairs(limits, us, us, 100);
  CHECK(cut.warm_up);
  CHECK(cut.frames.size() == 50);
  CHECK_FALSE(whole.warm_up);
  CHECK_FALSE(cold.warm_up);
  CHECK(cold.frames.size() == 50);
}

TEST_CASE("plan: each frame once, in the order of the flight") {
  support::Random random(3);
  for (const std::size_t frames : {1U, 2U, 5U, 77U, 300U}) {
    std::vector<double> us(frames);
    for (double& one : us) one = random.unit();
    const Plan plan = plan_pairs({.seconds = 0, .pairs = 9, .least_pairs = 9, .least_frames = 5}, us, us, 0);
    REQUIRE(plan.frames.size() == std::min<std::size_t>(frames, 5));
    for (std::size_t i = 0; i < plan.frames.size(); ++i) {
      CHECK(plan.frames[i] < frames);
      if (i > 0) CHECK(plan.frames[i] > plan.frames[i - 1]);
    }
  }
}

TEST_CASE("plan: five frames stand for a flight whose costs differ by thousands") {
  support::Random random(4);
  for (int round = 0; round < 100; ++round) {
    std::vector<double> bqr, peer;
    const double steep = random.within(0, 8), shift = random.within(0, 1);
    for (int frame = 0; frame < 300; ++frame) {
      const double along = std::exp(steep * std::sin(6 * (frame / 300.0 + shift)));
      bqr.push_back(along * random.within(0.95, 1.05));
      peer.push_back(20 * std::sqrt(along) * random.within(0.95, 1.05));
    }
    const Plan plan = plan_pairs({.seconds = 0, .pairs = 9, .least_pairs = 9, .least_frames = 5}, bqr, peer, 0);
    const auto at = [&](const std::vector<double>& us) {
      std::vector<double> some;
      for (const std::size_t frame : plan.frames) some.push_back(us[frame]);
      return manzana::apps::median(some);
    };
    CAPTURE(steep, shift);
    CHECK(at(bqr) == Approx(manzana::apps::median(bqr)).epsilon(0.25));
    CHECK(at(peer) == Approx(manzana::apps::median(peer)).epsilon(0.25));
  }
}

TEST_CASE("pairs: a structure that takes three times as long is found to, whoever else is at work") {
  Cities cities;
  const Workload work = make_workload("C1", 1, 20, cities);
  Waiting quick(20, 1), slow(60, 1);
  const PairTimes times =
      time_pairs({&quick, {}, &work.frusta}, {&slow, {}, &work.frusta}, false, {flight_of(20), 15}, 1);
  REQUIRE(times.peer_us.size() == 15);
  REQUIRE(times.bqr_us.size() == 15);
  CHECK(times.frame_us.size() == 20);
  CHECK(quick.queries == slow.queries);
  std::vector<double> ratios;
  for (std::size_t i = 0; i < 15; ++i) ratios.push_back(times.peer_us[i] / times.bqr_us[i]);
  CHECK(manzana::apps::median_ratio(ratios) == Approx(3).epsilon(0.1));
}

TEST_CASE("pairs: an untimed round goes before each that counts") {
  Cities cities;
  const Workload work = make_workload("C1", 1, 20, cities);
  Waiting bqr(1, 1), peer(1, 1);
  time_pairs({&bqr, {}, &work.frusta}, {&peer, {}, &work.frusta}, false, {flight_of(20), 5, true}, 1);
  CHECK(bqr.queries == 2 * 20 * 6);
  CHECK(peer.queries == 2 * 20 * 6);
}

TEST_CASE("pairs: the clock's own time is not counted") {
  const double overhead = clock_overhead_us();
  CHECK(overhead > 0.001);
  CHECK(overhead < 2);
  Cities cities;
  const Workload work = make_workload("C1", 1, 20, cities);
  Waiting nothing(0, 1), neither(0, 1);
  const PairTimes times =
      time_pairs({&nothing, {}, &work.frusta}, {&neither, {}, &work.frusta}, false, {flight_of(20), 50}, 1);
  CHECK(manzana::apps::median(times.peer_us) < 2 * overhead + 0.1);
}

TEST_CASE("check: counts what an answer holds, holds too much, and misses") {
  Cities cities;
  const Workload work = make_workload("C1", 1, 5, cities);
  const Truth truth = find_truth(work);
  const std::uint32_t objects = work.city->objects();
  Waiting all(0, objects), half(0, objects, objects / 2);
  const Counts of_all = sum(check(all, work, truth)), of_half = sum(check(half, work, truth));
  std::uint64_t triangles = 0, seen = 0, seen_below = 0;
  for (const std::uint32_t t : work.city->triangles) triangles += t;
  for (const auto& bits : truth.bits)
    for (std::uint32_t i = 0; i < objects; ++i) {
      seen += bits[i / 64] >> i % 64 & 1;
      seen_below += i < objects / 2 ? bits[i / 64] >> i % 64 & 1 : 0;
    }
  CHECK(of_all.accepted == 5 * std::uint64_t{objects});
  CHECK(of_all.exact == seen);
  CHECK(of_all.missed == 0);
  CHECK(of_all.triangles == 5 * triangles);
  CHECK(of_half.missed == seen_below);
  CHECK(seen_below > 0);
  CHECK(of_half.accepted == 5 * std::uint64_t{objects - objects / 2});
}

TEST_CASE("truth: a kept one is read again and is the same, a part of one is found anew") {
  const TemporaryFolder folder;
  Cities cities;
  const Workload work = make_workload("C1", 1, 5, cities), shorter = make_workload("C1", 1, 4, cities);
  const Truth found = find_truth(work);
  CHECK(kept_truth(work, folder.path() / "truth").bits == found.bits);
  REQUIRE(files_in(folder.path() / "truth") == 1);
  const auto file = std::filesystem::directory_iterator(folder.path() / "truth")->path();
  const auto written = std::filesystem::last_write_time(file);
  CHECK(kept_truth(work, folder.path() / "truth").bits == found.bits);
  CHECK(kept_truth(work, folder.path() / "truth").seen == found.seen);
  CHECK(std::filesystem::last_write_time(file) == written);
  CHECK(kept_truth(shorter, folder.path() / "truth").bits.size() == 4);
  CHECK(files_in(folder.path() / "truth") == 2);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 1);
  CHECK(kept_truth(work, folder.path() / "truth").bits == found.bits);
}

TEST_CASE("pairs: in company the others fly too, and land when the round is over") {
  Cities cities;
  const Workload work = make_workload("C1", 1, 20, cities);
  Waiting bqr(5, 1), peer(5, 1), of_bqr(1, 1), of_peer(1, 1);
  time_pairs({&bqr, {&of_bqr}, &work.frusta}, {&peer, {&of_peer}, &work.frusta}, false, {flight_of(20), 5}, 1);
  CHECK(bqr.queries == 20 * 6);
  CHECK(of_bqr.queries >= 6);
  CHECK(of_peer.queries >= 6);
}

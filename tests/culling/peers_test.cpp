// Every structure of the benchmark against the exact answer.
#include <catch2/catch.hpp>
#include <iostream>

#include "culling/baselines/cases.h"
#include "culling/baselines/exact.h"
#include "culling/baselines/peer.h"
#include "tests/support/random.h"

namespace manzana::baselines {
namespace {

using culling::View;

constexpr double kEndless = std::numeric_limits<double>::infinity();

/// Frames of the flight, and cameras anywhere in the city.
std::vector<View> views(const City& city, std::uint64_t seed) {
  std::vector<View> all;
  for (int i = 0; i < 16; ++i) all.push_back(flight(city, i % 2 == 0 ? 700 : kEndless, i / 15.0));
  support::Random random(seed);
  const Vec3d size = city.bounds.max - city.bounds.min;
  for (int i = 0; i < 16; ++i) {
    const Vec3d at{random.within(-0.1, 1.1), random.within(-0.1, 1.1), random.within(0, 2)};
    const Vec3d forward{random.within(-1, 1), random.within(-1, 1), random.within(-1, 0.3)};
    all.push_back(culling::look(city.bounds.min + at * size, forward, Vec3d(0, 0, 1), random.within(0.02, 2.5), 1.6,
                                0.1, random.below(2) == 0 ? kEndless : random.within(10, 2000)));
  }
  return all;
}

/// Accepted over exact, of a peer that decides about single objects.
constexpr double kMostExcess = 1.02;

struct Sums {
  std::uint64_t accepted = 0, exact = 0, missed = 0;
};

struct Asked {
  View view;
  std::vector<bool> seen;  ///< exactly, a flag an object
};

void ask(Peer& peer, const Asked& asked, Answer& answer, Sums& sums) {
  peer.query(make_frustum(asked.view), answer);
  const std::vector<std::uint32_t> rows = taken(peer, answer);
  CHECK(std::adjacent_find(rows.begin(), rows.end()) == rows.end());
  const auto visible = static_cast<std::uint64_t>(std::count(asked.seen.begin(), asked.seen.end(), true));
  const auto found = static_cast<std::uint64_t>(
      std::count_if(rows.begin(), rows.end(), [&](std::uint32_t row) { return asked.seen[row]; }));
  sums.accepted += rows.size();
  sums.exact += visible;
  sums.missed += visible - found;
}

void check_peer(const PeerInfo& info, const City& city, const std::vector<Asked>& asked) {
  const auto peer = info.make(city);
  Answer answer;
  Sums sums;
  for (const Asked& each : asked) ask(*peer, each, answer, sums);
  CHECK(sums.missed == 0);
  CHECK(sums.exact > 0);
  const double excess = static_cast<double>(sums.accepted) / static_cast<double>(sums.exact);
  if (info.grain == Grain::object && info.slug != "none") CHECK(excess <= kMostExcess);
  std::cout << info.slug << ": accepted/exact " << excess << '\n';
}

void check_peers(const City& city, std::uint64_t seed) {
  std::vector<Asked> asked;
  for (const View& view : views(city, seed)) asked.push_back({view, exactly_visible(view, city.boxes)});
  for (const PeerInfo& info : peers()) {
    INFO(info.slug << ", seed " << seed);
    if (info.available) check_peer(info, city, asked);
  }
}

TEST_CASE("no peer loses an object of C2, here and at UTM coordinates") {
  const City city = make_city(*find_case("C2"), 11);
  check_peers(city, 12);
  check_peers(moved(city, {676000, 4613000, 200}), 13);
}

TEST_CASE("no peer loses an object of the 10k city, here and at UTM coordinates") {
  const City city = make_city(*find_case("10k"), 14);
  check_peers(city, 15);
  check_peers(moved(city, {676000, 4613000, 200}), 16);
}

TEST_CASE("peers answer an empty city and a single block") {
  for (const PeerInfo& info : peers()) {
    if (!info.available) continue;
    for (const City& city : {City{}, make_city(1, 1)}) {
      const auto peer = info.make(city);
      Answer answer;
      peer->query(make_frustum(culling::look({0, -500, 20}, {0, 1, 0}, {0, 0, 1}, 1, 1)), answer);
      CHECK(taken(*peer, answer).size() == city.objects());
    }
  }
}

TEST_CASE("every peer is found by its slug") {
  for (const PeerInfo& info : peers()) CHECK(find_peer(info.slug) == &info);
  CHECK(find_peer("quadtree") == nullptr);
  CHECK(peers().front().slug == "bqr");
}

}  // namespace
}  // namespace manzana::baselines

#include "apps/culling_benchmark/trade.h"

#include <map>

#include "apps/culling_benchmark/report_trade.h"
#include "apps/culling_benchmark/slabs.h"
#include "apps/culling_benchmark/truth.h"
#include "culling/baselines/exact.h"
#include "culling/baselines/touching.h"
#include "tests/support/random.h"

using namespace manzana;
using namespace manzana::culling_benchmark;

namespace {

culling::View random_view(support::Random& random, double away) {
  const auto direction = [&] { return Vec3d(random.within(-1, 1), random.within(-1, 1), random.within(-1, 1)); };
  const double far_m = random.below(2) == 0 ? std::numeric_limits<double>::infinity() : random.within(10, 1000);
  return culling::look(direction() * away, direction(), direction(), random.within(0.1, 2.5), random.within(0.5, 2),
                       0.1, far_m);
}

template <class Real>
bool kept(const culling::FrustumD& frustum, const culling::BoxD& box) {
  const auto slabs = narrow_slabs<Real>(all_slabs(frustum), frustum.eye, frustum.eye);
  return !apart(slabs, Brick<Real>{Vec<Real>(box.min - frustum.eye), Vec<Real>(box.max - frustum.eye)});
}

}  // namespace

TEST_CASE("slabs: all of them decide as the exact answer does, unless the box all but touches") {
  support::Random random(21);
  std::size_t seen = 0, too_many = 0, missed = 0, all = 0;
  for (int round = 0; round < 200; ++round) {
    const culling::View view = random_view(random, 100);
    const auto frustum = make_frustum(view);
    const auto body = culling::make_exact(view);
    for (int i = 0; i < 200; ++i, ++all) {
      const Vec3d at =
          view.eye + random.within(0, 300) * Vec3d(random.within(-1, 1), random.within(-1, 1), random.within(-1, 1));
      const Vec3d half{random.within(0, 30), random.within(0, 30), random.within(0, 30)};
      const culling::BoxD box{at - half, at + half};
      const bool exact = culling::exactly_overlaps(body, box);
      seen += exact ? 1 : 0;
      missed += exact && !kept<double>(frustum, box) ? 1 : 0;
      too_many += !exact && kept<double>(frustum, box) ? 1 : 0;
    }
  }
  CHECK(missed == 0);
  CHECK(too_many == 0);
  CHECK(seen > all / 20);
  CHECK(seen < all * 9 / 10);
}

TEST_CASE("slabs: no box that touches what the camera sees is apart, in any precision") {
  support::Random random(22);
  baselines::Random other(22);
  std::size_t missed = 0, touching = 0;
  for (int round = 0; round < 300; ++round) {
    const culling::View view = random_view(random, 1000);
    const auto body = culling::make_exact(view);
    const auto frustum = make_frustum(view);
    for (int i = 0; i < 100; ++i) {
      const Vec3d size{random.within(0, 9), random.within(0, 9), random.within(0, 9)};
      const auto box = box_along_axis(body, other, size, 1e-9, 200);
      if (!culling::exactly_overlaps(body, box)) continue;
      ++touching;
      missed += kept<double>(frustum, box) ? 0 : 1;
    }
  }
  CHECK(touching > 10000);
  CHECK(missed == 0);
}

TEST_CASE("trade: no variant misses anything at any place, and volumes and precisions rank as they must") {
  Cities cities;
  for (const TradePlace& place : trade_places()) {
    const Workload work = make_workload(place.name, 1, 24, cities);
    const Truth truth = find_truth(work);
    std::map<std::string, Counts> counts;
    for (const baselines::PeerInfo& variant : trade_peers()) {
      const auto peer = variant.make(*work.city);
      counts[std::string(variant.slug)] = sum(check(*peer, work, truth));
      CAPTURE(place.name, variant.slug);
      CHECK(counts[std::string(variant.slug)].missed == 0);
    }
    for (const char* precision : {"-world", "-local", "-relative", "-double"}) {
      const auto accepted = [&](const char* volume) { return counts[std::string(volume) + precision].accepted; };
      CAPTURE(place.name, precision);
      CHECK(accepted("exact") <= accepted("box"));
      CHECK(accepted("both") <= accepted("box"));
      CHECK(accepted("both") <= accepted("sphere"));
      CHECK(accepted("box") < accepted("sphere"));
    }
    CHECK(counts["exact-double"].accepted == counts["exact-double"].exact);
    if (place.name != "trade-origin") CHECK(counts["box-world"].accepted > counts["box-local"].accepted);
  }
}

TEST_CASE("trade: the front is what nothing beats in both") {
  const auto row = [](const char* peer, double ratio, std::uint64_t accepted) {
    SummaryRow s;
    s.case_name = "trade-origin";
    s.peer = peer;
    s.ratio = ratio;
    s.accepted = accepted;
    return s;
  };
  const std::vector<SummaryRow> table{row("bqr", 0.1, 1), row("a", 1, 10), row("b", 2, 5), row("c", 2, 10),
                                      row("d", 3, 6)};
  CHECK(on_front(table, table[1]));
  CHECK(on_front(table, table[2]));
  CHECK_FALSE(on_front(table, table[3]));
  CHECK_FALSE(on_front(table, table[4]));
  const auto front = trade_front(table);
  REQUIRE(front.size() == 2);
  CHECK(front[0].peer == "a");
  CHECK(front[1].peer == "b");
}

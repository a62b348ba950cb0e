#include "apps/culling_benchmark/growth.h"

#include <algorithm>
#include <set>

#include "apps/culling_benchmark/report_growth.h"
#include "apps/culling_benchmark/sharing.h"
#include "apps/culling_benchmark/truth.h"
#include "culling/baselines/peer.h"
#include "tests/support/temporary_folder.h"

using namespace manzana;
using namespace manzana::culling_benchmark;

TEST_CASE("growth: sizes from a thousand to ten million, cold and on two threads, structures that exist") {
  std::set<std::uint32_t> sizes;
  int cold = 0, threads = 0;
  for (const Growth& growth : growth_cases()) {
    sizes.insert(growth.objects);
    cold += growth.cold ? 1 : 0;
    threads += growth.threads == 2 ? 1 : 0;
    CHECK(find_growth(growth.name) == &growth);
    CHECK(case_info(growth.name).family == Family::growth);
  }
  CHECK(*sizes.begin() == 1000);
  CHECK(*sizes.rbegin() == 10'000'000);
  CHECK(cold == 5);
  CHECK(threads == 5);
  CHECK(find_growth("grow-2k-all") == nullptr);
}

TEST_CASE("growth: all in view is all in view, whatever the size, to 1 km it is what is there") {
  Cities cities;
  for (const char* name : {"grow-1k-all", "grow-10k-all", "grow-100k-all"}) {
    const Workload work = make_workload(name, 1, 12, cities);
    const Truth truth = find_truth(work);
    for (const std::uint64_t seen : truth.seen) CHECK(seen == work.city->objects());
  }
  const auto seen_at_most = [&](const char* name) {
    const auto seen = find_truth(make_workload(name, 1, 12, cities)).seen;
    return *std::max_element(seen.begin(), seen.end());
  };
  CHECK(seen_at_most("grow-100k-1km") < 20'000);
  CHECK(seen_at_most("grow-1k-1km") <= 1000);
}

TEST_CASE("cities: neighbours share one, others do not") {
  Cities cities;
  const auto small = cities.get("grow-1k-all", 1);
  CHECK(cities.get("grow-1k-1km-cold", 1) == small);
  CHECK(cities.get("grow-1k-all", 2) != small);
  const auto middle = cities.get("10k", 1);
  CHECK(middle->objects() == 10'000);
  CHECK(cities.get("trade-utm", 1)->bounds.min.x > 600'000);
}

TEST_CASE("growth: the table has a row a size and a cell a structure, empty where there is no figure") {
  std::vector<SummaryRow> table;
  for (const char* name : {"grow-1k-1km", "grow-10k-1km", "grow-1k-all", "grow-10k-all"})
    for (const char* peer : {"bqr", "vam16"}) {
      SummaryRow s;
      s.case_name = name;
      s.peer = peer;
      s.median_us = s.case_name.starts_with("grow-10k") ? 2.5 : 1;
      s.ratio = s.ratio_lo = 3;
      s.ratio_hi = 4;
      s.accepted = 1000;
      s.frames = 10;
      table.push_back(s);
    }
  const std::string text = growth_text(table);
  CHECK(text.find("| 10 000 | 2.50 |  |  |  | 2.50 (3.00 [3.00, 4.00]) | 100 |") != std::string::npos);
  CHECK(text.find("two threads") == std::string::npos);
  CHECK(growth_text({}).empty());
  REQUIRE(growth_plots(table).size() == 1);
  const TemporaryFolder folder;
  const auto drawn = manzana::apps::draw_all(folder.path(), growth_plots(table));
  CHECK(std::filesystem::exists(folder.path() / "plots" / "growth.gp"));
  CHECK(std::filesystem::exists(folder.path() / "growth.svg") == !drawn.empty());
}

TEST_CASE("growth: one query on all threads, in a file and in the report") {
  double done = 0;
  const SharingRun run =
      run_sharing({.cases = {"grow-1k-all", "grow-1M-all"}, .rounds = 3, .rest_ms = 0}, [&](double now) {
        CHECK(now > done);
        done = now;
      });
  CHECK(done == 1);
  REQUIRE(run.rows.size() == 10);
  for (std::size_t i = 0; i < 5; ++i) CHECK(run.rows[i].shared == 0);  // no city of 40 blocks is large enough
  CHECK(run.rows[5].shared == 0);                                      // nor is what a camera in the streets sees
  CHECK(run.rows[9].shared == 1);
  CHECK(run.rows[9].nodes > culling::kSharedAbove);
  const TemporaryFolder folder;
  write_sharing(folder.path(), run);
  CHECK(std::filesystem::exists(folder.path() / "sharing.csv"));
  const std::string text = sharing_md(run);
  CHECK(text.find("| 1 000 000 | trees alone, all in view | ") != std::string::npos);
}

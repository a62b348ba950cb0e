// What is missed and falsely kept, and how it is told.
#include "apps/culling_benchmark/extremes.h"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "apps/culling_benchmark/extremes_tables.h"
#include "culling/baselines/naive.h"
#include "culling/baselines/places.h"

namespace manzana::culling_benchmark {
namespace {

const Extremes& small_run() {
  static const Extremes extremes = run_extremes({.seed = 3, .cameras = 4, .objects = 25}, [](double) {});
  return extremes;
}

ExtremesSum of_way(const std::string& way, const std::string& objects) {
  return sum(small_run(), [&](const ExtremesRow& r) { return r.way == way && r.objects == objects; });
}

TEST_CASE("extremes: a row for every place, depths, field of view, way and sort of object") {
  const std::size_t cameras = baselines::kPlaces.size() * baselines::kDepths.size() * baselines::kFieldsDeg.size();
  CHECK(small_run().rows.size() == cameras * (1 + baselines::naive_ways().size()) * 2);
  for (const ExtremesRow& row : small_run().rows) {
    CHECK(row.asked == 100);
    CHECK(row.missed <= row.seen);
    CHECK(row.falsely_kept <= row.asked - row.seen);
    CHECK((row.missed > 0) == (row.deepest_missed_m > 0));
  }
}

TEST_CASE("extremes: the tree misses nothing, every way without a margin misses what touches") {
  for (const char* objects : {"any", "touching"}) CHECK(of_way("bqr", objects).missed == 0);
  CHECK(of_way("bqr", "any").seen > 1000);
  CHECK(of_way("bqr", "any").falsely_kept_percent() < 15);
  for (const baselines::NaiveWay& way : baselines::naive_ways())
    CHECK(of_way(std::string(way.slug), "touching").missed > 10);
  CHECK(of_way("float-world", "any").missed > 100);
}

TEST_CASE("extremes: the library's far plane is never too near, and gone when the matrix is of floats") {
  int ours = 0;
  double worst = 0;
  for (const FarRow& row : small_run().far) {
    worst = std::max(worst, row.inward_m);
    if (!row.way.starts_with("bqr")) continue;
    ++ours;
    CHECK(row.inward_m <= 1e-8);  // the eye's own rounding at the pole
    CHECK(row.without == (row.precision == "float" ? row.cameras : 0));
  }
  CHECK(ours == 2 * 7 * 5);
  CHECK(worst > 1000);
}

TEST_CASE("extremes: a seed gives the same answers on any number of threads") {
  const Extremes again = run_extremes({.seed = 3, .cameras = 4, .objects = 25}, [](double) {});
  CHECK(extremes_md(again) == extremes_md(small_run()));
  CHECK(extremes_svg(again) == extremes_svg(small_run()));
  const Extremes other = run_extremes({.seed = 4, .cameras = 1, .objects = 5}, [](double) {});
  CHECK(extremes_md(other) != extremes_md(small_run()));
}

TEST_CASE("extremes: progress reaches the end") {
  std::atomic<int> calls{0}, ends{0};
  run_extremes({.cameras = 1, .objects = 1}, [&](double done) {
    ++calls;
    ends += done == 1 ? 1 : 0;
  });
  CHECK(calls == 7 * 6);
  CHECK(ends == 1);
}

TEST_CASE("extremes: files and a section of the report") {
  const auto folder = std::filesystem::temp_directory_path() / "manzana_extremes_test";
  std::filesystem::create_directories(folder);
  write_extremes(folder, small_run());
  std::ifstream csv(folder / "extremes.csv");
  std::string line;
  REQUIRE(std::getline(csv, line));
  CHECK(line == "place,near_m,far_m,fovy_deg,way,precision,objects,asked,seen,missed,falsely_kept,deepest_missed_m");
  std::size_t lines = 0;
  while (std::getline(csv, line)) ++lines;
  CHECK(lines == small_run().rows.size());
  std::stringstream svg;
  svg << std::ifstream(folder / "extremes.svg").rdbuf();
  CHECK(svg.str().starts_with("<svg"));
  CHECK(svg.str().ends_with("</svg>\n"));
  std::filesystem::remove_all(folder);
  const std::string text = extremes_md(small_run());
  CHECK(text.find("bqr missed 0 of ") != std::string::npos);
  for (const auto& place : baselines::kPlaces) CHECK(text.find(std::string(place.name)) != std::string::npos);
}

TEST_CASE("extremes: sums and pivots") {
  Extremes e;
  e.rows = {{"a", 1, 2, 60, "x", "", "any", 10, 8, 2, 1, 0.5},
            {"b", 1, 2, 60, "x", "", "any", 10, 10, 1, 0, 0.7},
            {"a", 1, 2, 60, "y", "", "any", 10, 8, 0, 2, 0}};
  const ExtremesSum all = sum(e, [](const ExtremesRow& r) { return r.way == "x"; });
  CHECK(all.missed_percent() == Approx(100 * 3 / 18.0));
  CHECK(all.falsely_kept_percent() == Approx(50));
  CHECK(all.deepest_missed_m == 0.7);
  const auto cells = pivot(
      e, [](const ExtremesRow&) { return true; }, [](const ExtremesRow& r) { return r.place; },
      [](const ExtremesSum& s) { return std::to_string(static_cast<int>(s.missed)); });
  CHECK(cells == std::vector<std::vector<std::string>>{{"", "a", "b"}, {"x", "2", "1"}, {"y", "0"}});
}

}  // namespace
}  // namespace manzana::culling_benchmark

#include "scenegraph/import/fallback_cells.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <iostream>

#include "tests/import/blocks/made_streets.h"

using namespace manzana;

namespace {

// What must hold for any points.
void check(const std::vector<Vec2d>& points, const CellOptions& options = {}) {
  const FallbackCells cells = fallback_cells(points, options);
  REQUIRE(cells.of.size() == points.size());
  std::vector<std::uint32_t> weight(cells.cells.size(), 0);
  std::vector<PlanBox> boxes(cells.cells.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    REQUIRE(cells.of[i] < cells.cells.size());
    ++weight[cells.of[i]];
    boxes[cells.of[i]].add(points[i]);
  }
  for (std::size_t c = 0; c < boxes.size(); ++c) {
    REQUIRE(weight[c] > 0);
    REQUIRE(boxes[c].lo == cells.cells[c].lo);
    REQUIRE(boxes[c].hi == cells.cells[c].hi);
    REQUIRE(boxes[c].size() <= options.size);
    const bool small = boxes[c].size() == 0 || boxes[c].size() < 2 * options.smallest;
    REQUIRE((weight[c] <= options.weight || small));
  }
}

// The same sets, as the least row of each point's cell.
std::vector<Vec2d> first_in_cell(const std::vector<Vec2d>& points) {
  const FallbackCells cells = fallback_cells(points);
  std::vector<Vec2d> least(cells.cells.size(), Vec2d(1e300, 0)), result;
  const auto less = [](const Vec2d& a, const Vec2d& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
  for (std::size_t i = 0; i < points.size(); ++i)
    if (less(points[i], least[cells.of[i]])) least[cells.of[i]] = points[i];
  for (std::size_t i = 0; i < points.size(); ++i) result.push_back(least[cells.of[i]]);
  return result;
}

}  // namespace

TEST_CASE("fallback cells: bounded in weight and size") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    std::cout << "fallback cells: seed " << seed << '\n';
    std::vector<Vec2d> points = test::random_points(seed, 3000, {0, 0}, {5000, 3000});
    const std::vector<Vec2d> village = test::random_points(seed + 100, 3000, {1000, 1000}, {1200, 1300});
    points.insert(points.end(), village.begin(), village.end());
    check(points);
    check(points, {.weight = 8, .size = 100, .smallest = 20});
    check(points, {.weight = 1, .size = 1e9, .smallest = 1});
  }
}

TEST_CASE("fallback cells do not depend on the order of the points") {
  const std::vector<Vec2d> points = test::random_points(3, 2000, {0, 0}, {3000, 3000});
  const std::vector<Vec2d> backwards(points.rbegin(), points.rend());
  const std::vector<Vec2d> a = first_in_cell(points), b = first_in_cell(backwards);
  CHECK(std::equal(a.begin(), a.end(), b.rbegin()));
}

TEST_CASE("fallback cells end on hostile points") {
  check({});
  check({{5, 5}});
  CHECK(fallback_cells(std::vector<Vec2d>(1000, Vec2d(3, 4))).cells.size() == 1);
  check(std::vector<Vec2d>(1000, Vec2d(676000, 4613000)), {.weight = 4, .size = 0, .smallest = 0});
  std::vector<Vec2d> line, halves;
  for (int i = 0; i < 1000; ++i) line.emplace_back(i * 10.0, 0), halves.emplace_back(std::ldexp(1e6, -i), 0);
  check(line);
  check(halves);
  check(halves, {.weight = 1, .size = 400, .smallest = 0});
  check({{-1e308, -1e308}, {1e308, 1e308}, {1e308, -1e308}, {0, 0}});
  // One unit in the last place apart: no number lies between, so they stay together whatever their weight.
  check({{676000, 0}, {std::nextafter(676000, 1e9), 0}, {676000, 0}}, {.weight = 3, .size = 400, .smallest = 0});
}

TEST_CASE("sparse country: cells stay small, so a cell is never mostly empty land") {
  std::vector<Vec2d> farms;
  for (int i = 0; i < 100; ++i) farms.emplace_back(i % 10 * 1000.0, i / 10 * 1000.0);
  CHECK(fallback_cells(farms).cells.size() == 100);
}

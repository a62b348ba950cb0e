#pragma once
/// Street networks made for tests. A node's id follows from its place, so streets meet where they have equal points.
#include <cmath>
#include <vector>

#include "scenegraph/import/street_graph.h"

namespace manzana::test {

inline std::int64_t node_at(const Vec2d& p) {
  return std::llround(p.x * 100) * 1'000'000'007LL + std::llround(p.y * 100);
}

inline StreetFeature street(std::vector<Vec2d> line, StreetClass kind = StreetClass::residential) {
  StreetFeature s;
  s.where = "made";
  for (const Vec2d& p : line) s.nodes.push_back(node_at(p));
  s.line = std::move(line);
  s.kind = kind;
  return s;
}

/// columns x rows square blocks of `side` metres from the origin; every street is one way with a node a crossing.
inline std::vector<StreetFeature> grid(int columns, int rows, double side) {
  std::vector<StreetFeature> streets;
  for (int x = 0; x <= columns; ++x) {
    std::vector<Vec2d> line;
    for (int y = 0; y <= rows; ++y) line.emplace_back(x * side, y * side);
    streets.push_back(street(line));
  }
  for (int y = 0; y <= rows; ++y) {
    std::vector<Vec2d> line;
    for (int x = 0; x <= columns; ++x) line.emplace_back(x * side, y * side);
    streets.push_back(street(line));
  }
  return streets;
}

inline StreetGraph graph_of(std::vector<StreetFeature> streets) {
  std::vector<Issue> issues;
  return build_street_graph(std::move(streets), issues);
}

/// Counter hash [numerics R6]: uniform in [0, 1).
inline double random01(std::uint64_t seed, std::uint64_t i) {
  std::uint64_t x = seed * 0x9e3779b97f4a7c15ULL + i + 1;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  x ^= x >> 31;
  x = (x + 0x9e3779b97f4a7c15ULL) * 0xbf58476d1ce4e5b9ULL;
  return static_cast<double>((x ^ (x >> 29)) >> 11) * 0x1p-53;
}
inline std::vector<Vec2d> random_points(std::uint64_t seed, std::size_t n, Vec2d lo, Vec2d hi) {
  std::vector<Vec2d> points(n);
  for (std::size_t i = 0; i < n; ++i)
    points[i] = lo + (hi - lo) * Vec2d(random01(seed, 2 * i), random01(seed, 2 * i + 1));
  return points;
}

}  // namespace manzana::test

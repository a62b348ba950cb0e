#pragma once
/// The distance of a point to what a camera sees, in long double, by looking at every face, edge and corner; and points
/// on its surface with a direction that leads straight away from it. The oracle of the sphere tests.
#include <algorithm>
#include <cmath>
#include <vector>

#include "culling/baselines/exact.h"
#include "culling/baselines/random.h"

namespace manzana::culling::test {

using baselines::Random;
using Real = long double;
using Vec3l = glm::vec<3, Real>;

struct PlaneL {
  Vec3l normal;
  Real offset;
};
struct Edge {
  Vec3l from, along;  ///< along has length 1
  Real length;
};

/// Relative to the eye, metres.
struct Polytope {
  std::vector<PlaneL> planes;  ///< kept side as culling::Plane
  std::vector<Edge> edges;
  Vec3l right, up, forward;
};

inline Polytope make_polytope(const View& view) {
  Polytope p;
  p.forward = glm::normalize(Vec3l(view.forward));
  p.right = Vec3l(view.right);
  p.right = glm::normalize(p.right - glm::dot(p.right, p.forward) * p.forward);
  p.up = Vec3l(view.up);
  p.up -= glm::dot(p.up, p.forward) * p.forward;
  p.up = glm::normalize(p.up - glm::dot(p.up, p.right) * p.right);
  const Real l = static_cast<Real>(view.tan_left), r = static_cast<Real>(view.tan_right);
  const Real b = static_cast<Real>(view.tan_bottom), t = static_cast<Real>(view.tan_top);
  p.planes = {{glm::normalize(p.right - l * p.forward), 0},
              {glm::normalize(r * p.forward - p.right), 0},
              {glm::normalize(p.up - b * p.forward), 0},
              {glm::normalize(t * p.forward - p.up), 0},
              {p.forward, -static_cast<Real>(view.near_m)}};
  const bool infinite = !std::isfinite(view.far_m);
  const Real n = static_cast<Real>(view.near_m), f = static_cast<Real>(view.far_m);
  if (!infinite) p.planes.push_back({-p.forward, f});
  std::vector<Vec3l> sides;
  for (const auto& [x, y] : {std::pair{l, b}, std::pair{r, b}, std::pair{r, t}, std::pair{l, t}})
    sides.push_back(p.forward + x * p.right + y * p.up);
  const auto add = [&](const Vec3l& from, const Vec3l& to) {
    p.edges.push_back({from, glm::normalize(to - from), glm::length(to - from)});
  };
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3l& next = sides[(k + 1) % 4];
    add(n * sides[k], n * next);
    if (!infinite) add(f * sides[k], f * next);
    p.edges.push_back(
        {n * sides[k], glm::normalize(sides[k]), (infinite ? Real{1e30L} : f - n) * glm::length(sides[k])});
  }
  return p;
}

inline bool holds(const Polytope& p, const Vec3l& point, Real tolerance) {
  return std::all_of(p.planes.begin(), p.planes.end(),
                     [&](const PlaneL& plane) { return glm::dot(plane.normal, point) + plane.offset >= -tolerance; });
}

/// Exact to about 1e-18 of the coordinates.
inline Real distance_to(const Polytope& p, const Vec3l& c) {
  if (holds(p, c, 0)) return 0;
  Real best = std::numeric_limits<Real>::infinity();
  for (const PlaneL& plane : p.planes) {
    const Real s = glm::dot(plane.normal, c) + plane.offset;
    const Vec3l foot = c - s * plane.normal;
    if (s < 0 && holds(p, foot, 1e-16L * (1 + glm::length(foot)))) best = std::min(best, -s);
  }
  for (const Edge& e : p.edges) {
    const Real at = std::clamp(glm::dot(c - e.from, e.along), Real{0}, e.length);
    best = std::min(best, glm::length(c - (e.from + at * e.along)));
  }
  return best;
}

/// A point of the surface, and a unit vector along which every step leads straight away.
struct Touch {
  Vec3l point, away;
};

/// `kind` 0 a face, 1 an edge, 2 a corner. `reach`: how far along unbounded edges.
inline Touch touch(const Polytope& p, Random& random, int kind, double reach) {
  const auto on = [&](const Edge& e) {
    const Real most = std::min(e.length, static_cast<Real>(reach));
    return e.from +
           e.along * (kind == 2 ? (random.unit() < 0.5 ? 0 : e.length) : most * static_cast<Real>(random.unit()));
  };
  const auto pick = [&] { return p.edges[random.below(p.edges.size())]; };
  for (;;) {
    Edge e = pick();
    if (kind == 2 && e.length > 1e20L) e.length = 0;
    Vec3l point = on(e);
    if (kind == 0) {
      const Real w = static_cast<Real>(random.unit());
      point = w * point + (1 - w) * on(pick());
    }
    // The planes through the point span the cone of directions away from the body.
    Vec3l away(0);
    int through = 0;
    for (const PlaneL& plane : p.planes) {
      if (std::abs(glm::dot(plane.normal, point) + plane.offset) > 1e-15L * (1 + glm::length(point))) continue;
      away -= static_cast<Real>(random.in(0.001, 1)) * plane.normal;
      ++through;
    }
    if (through > 0) return {point, glm::normalize(away)};
  }
}

/// Cameras of all sorts: places near and far, any direction, narrow and wide, off the axis, mirrored, with and without
/// a far plane.
inline View random_view(Random& random, const Vec3d& eye) {
  const double fovy = random.unit() < 0.5 ? 1.047 : random.scale(2e-5, 3.12);
  const double aspect = random.unit() < 0.5 ? 16.0 / 9 : random.scale(1e-3, 1e3);
  constexpr std::array<std::array<double, 2>, 5> kDepths{
      {{0.1, 5e3}, {0.1, 1e5}, {0.01, 1e6}, {1, 5e3}, {0.1, std::numeric_limits<double>::infinity()}}};
  const auto& [near_m, far_m] = kDepths[random.below(kDepths.size())];
  View view = look(eye, random.direction(), random.direction(), fovy, aspect, near_m, far_m);
  if (random.unit() < 0.2) view.tan_left = 0.3 * view.tan_right;
  if (random.unit() < 0.2) view.right = -view.right;
  return view;
}

/// Places of the eye [numerics 1].
inline std::vector<Vec3d> eyes() {
  return {{0, 0, 0}, {1e4, -1e4, 50}, {1e5, 1e5, 1.7}, {676000, 4613000, 200}, {4777000, -73500, 4229000}};
}

}  // namespace manzana::culling::test

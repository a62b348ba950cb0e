#include "scenegraph/import/roof_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace manzana {
namespace {

using plan::OrientedBox;
using plan::Ring;

double least(const std::vector<RoofPlane>& planes, const Vec2d& p) {
  double height = planes.empty() ? 0 : planes[0].at(p);
  for (const RoofPlane& plane : planes) height = std::min(height, plane.at(p));
  return std::max(height, 0.0);
}

/// Rises from 0 on a line (through `foot`, across `uphill`) by `pitch`.
RoofPlane rising(const Vec2d& foot, const Vec2d& uphill, double pitch) {
  return {uphill * pitch, -pitch * glm::dot(uphill, foot)};
}

std::vector<RoofPlane> rectangle_planes(const OrientedBox& box, double side_pitch, double end_pitch) {
  const Vec2d across = plan::left_of(box.along), side = across * box.half_width, end = box.along * box.half_length;
  std::vector<RoofPlane> planes{rising(box.center - side, across, side_pitch),
                                rising(box.center + side, -across, side_pitch)};
  if (end_pitch > 0) {
    planes.push_back(rising(box.center - end, box.along, end_pitch));
    planes.push_back(rising(box.center + end, -box.along, end_pitch));
  }
  return planes;
}

/// A plane a wall: the straight skeleton's roof, where the outline is convex.
std::vector<RoofPlane> wall_planes(const Ring& ring) {
  std::vector<RoofPlane> planes;
  for (std::size_t i = 0; i < ring.size(); ++i)
    planes.push_back(rising(ring[i], glm::normalize(plan::left_of(ring[(i + 1) % ring.size()] - ring[i])), 1));
  return planes;
}

/// The greatest height of the least of the planes: it lies where three of them meet.
double ridge_height(const std::vector<RoofPlane>& planes) {
  double best = 0;
  for (std::size_t i = 2; i < planes.size(); ++i)
    for (std::size_t j = 1; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        const Vec2d u = planes[i].slope - planes[k].slope, v = planes[j].slope - planes[k].slope;
        const double a = planes[k].height - planes[i].height, b = planes[k].height - planes[j].height;
        const double det = plan::cross(u, v);
        if (std::abs(det) < 1e-9) continue;
        const Vec2d meet = Vec2d{a * v.y - b * u.y, b * u.x - a * v.x} / det;
        best = std::max(best, least(planes, meet));
      }
  return best;
}

constexpr std::size_t kMostHips = 8;  // outlines with more corners are round: their hips follow the rectangle

std::vector<RoofPlane> hipped_planes(const Polygon& footprint, double height) {
  const bool by_walls =
      footprint.holes.empty() && footprint.outer.size() <= kMostHips && plan::strictly_convex(footprint.outer);
  if (!by_walls) {
    const OrientedBox box = plan::smallest_rectangle(footprint.outer);
    const double pitch = height / std::max(box.half_width, 0.01);
    return rectangle_planes(box, pitch, pitch);
  }
  std::vector<RoofPlane> planes = wall_planes(footprint.outer);
  const double scale = height / std::max(ridge_height(planes), 0.01);
  for (RoofPlane& plane : planes) plane = {plane.slope * scale, plane.height * scale};
  return planes;
}

std::vector<RoofPlane> planes_of(RoofShape shape, const Polygon& footprint, double height) {
  if (shape == RoofShape::hipped) return hipped_planes(footprint, height);
  const OrientedBox box = plan::smallest_rectangle(footprint.outer);
  const double width = std::max(box.half_width, 0.01), length = std::max(box.half_length, 0.01);
  const Vec2d across = plan::left_of(box.along);
  if (shape == RoofShape::skillion) return {rising(box.center - across * width, across, height / (2 * width))};
  return rectangle_planes(box, height / width, shape == RoofShape::gabled ? 0 : height / length);
}

/// The part of a convex ring where inside(p) >= 0, inside being linear.  [Sutherland and Hodgman 1974]
template <class Inside>
Ring clipped(const Ring& ring, Inside&& inside) {
  Ring result;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2d &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const double da = inside(a), db = inside(b);
    if (da >= 0) result.push_back(a);
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) result.push_back(a + (b - a) * (da / (da - db)));
  }
  return result;
}

Ring snapped_ring(const Ring& ring) {
  Ring result;
  for (const Vec2d& p : ring)
    if (const Vec2d q = snapped(p); result.empty() || q != result.back()) result.push_back(q);
  while (result.size() > 1 && result.front() == result.back()) result.pop_back();
  return result;
}

/// The part of a convex piece where plane i is the least; of equal planes the first.
Ring cell(const std::vector<RoofPlane>& planes, std::size_t i, Ring piece) {
  for (std::size_t j = 0; j < planes.size() && piece.size() >= 3; ++j) {
    if (j == i) continue;
    const RoofPlane difference{planes[j].slope - planes[i].slope, planes[j].height - planes[i].height};
    if (difference.slope == Vec2d{0, 0} && difference.height == 0 && j < i) return {};
    piece = clipped(piece, [&](const Vec2d& p) { return difference.at(p); });
  }
  return snapped_ring(piece);
}

void add_facet(Roof& roof, const RoofPlane& plane, const Ring& ring) {
  if (ring.size() < 3 || plan::area(ring) < 1e-7) return;
  RoofFacet facet{plane, {}};
  for (const Vec2d& p : ring) facet.corners.emplace_back(p, least(roof.planes, p));
  roof.facets.push_back(std::move(facet));
}

Roof planes_roof(std::vector<RoofPlane> planes, const Polygon& footprint,
                 const std::vector<plan::Triangle>& triangles) {
  Roof roof{{}, std::move(planes)};
  std::vector<Ring> pieces;
  if (footprint.holes.empty() && plan::strictly_convex(footprint.outer)) {
    pieces.push_back(footprint.outer);
  } else {
    for (const plan::Triangle& t : triangles) pieces.emplace_back(t.begin(), t.end());
  }
  for (const Ring& piece : pieces)
    for (std::size_t i = 0; i < roof.planes.size(); ++i) add_facet(roof, roof.planes[i], cell(roof.planes, i, piece));
  return roof;
}

RoofPlane plane_through(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d n = glm::cross(b - a, c - a);
  const Vec2d slope = Vec2d(n) / -n.z;
  return {slope, a.z - glm::dot(slope, Vec2d(a))};
}

/// Rings that shrink towards the centroid; heights[i] is that of the i-th, the last ring is a point.
Roof rings_roof(const Ring& outline, const std::vector<Vec2d>& scale_and_height) {
  Roof roof;
  const Vec2d middle = snapped(plan::centroid(outline));
  const auto point = [&](const Vec2d& p, const Vec2d& ring) {
    return Vec3d(ring.x == 1 ? p : snapped(middle + (p - middle) * ring.x), ring.y);
  };
  for (std::size_t r = 0; r + 1 < scale_and_height.size(); ++r)
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec2d &a = outline[i], &b = outline[(i + 1) % outline.size()];
      const Vec2d &low = scale_and_height[r], &high = scale_and_height[r + 1];
      RoofFacet facet{{}, {point(a, low), point(b, low), point(b, high)}};
      if (high.x > 0) facet.corners.push_back(point(a, high));
      facet.plane = plane_through(facet.corners[0], facet.corners[1], facet.corners[2]);
      roof.facets.push_back(std::move(facet));
    }
  return roof;
}

std::vector<Vec2d> dome_rings(double height) {
  constexpr int kRings = 5;
  std::vector<Vec2d> rings{{1, 0}};
  for (int i = 1; i < kRings; ++i) {
    const double angle = i * std::numbers::pi / 2 / kRings;
    rings.emplace_back(std::cos(angle), height * std::sin(angle));
  }
  rings.emplace_back(0, height);
  return rings;
}

Roof flat_roof(const std::vector<plan::Triangle>& triangles) {
  Roof roof;
  for (const plan::Triangle& t : triangles) add_facet(roof, {}, Ring(t.begin(), t.end()));
  return roof;
}

bool fan_fits(const Polygon& footprint) {
  return footprint.holes.empty() && plan::star_shaped_from(footprint.outer, plan::centroid(footprint.outer));
}

}  // namespace

Vec2d snapped(const Vec2d& p) { return glm::round(p * 65536.0) / 65536.0; }

RoofShape roof_that_fits(RoofShape shape, const Polygon& footprint) {
  return plan::smallest_rectangle(footprint.outer).half_width < 0.5 ? RoofShape::flat : shape;
}

Roof make_roof(RoofShape shape, const Polygon& footprint, const std::vector<plan::Triangle>& triangles,
               double roof_height) {
  if (shape == RoofShape::flat || !(roof_height > 0.01)) return flat_roof(triangles);
  if (shape == RoofShape::pyramidal && fan_fits(footprint))
    return rings_roof(footprint.outer, {{1, 0}, {0, roof_height}});
  if (shape == RoofShape::dome && fan_fits(footprint)) return rings_roof(footprint.outer, dome_rings(roof_height));
  return planes_roof(planes_of(shape, footprint, roof_height), footprint, triangles);
}

double default_roof_height(RoofShape shape, const Polygon& footprint, double body) {
  if (shape == RoofShape::flat) return 0;
  const double width = 2 * plan::smallest_rectangle(footprint.outer).half_width;
  const double wanted = shape == RoofShape::skillion ? 0.14 * width
                        : shape == RoofShape::dome   ? 0.5 * width
                                                     : 0.35 * width;  // tan 35 degrees = 0.70, over half the width
  constexpr double kStorey = 2.5;
  const double room = body > 1.25 * kStorey ? body - kStorey : 0.2 * body;
  return std::min({wanted, 0.6 * body, room});
}

std::vector<Vec3d> wall_top(const Roof& roof, const Vec2d& a, const Vec2d& b) {
  std::vector<double> bends{0, 1};
  for (std::size_t i = 0; i < roof.planes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double da = roof.planes[i].at(a) - roof.planes[j].at(a), db = roof.planes[i].at(b) - roof.planes[j].at(b);
      if (!((da > 0 && db < 0) || (da < 0 && db > 0))) continue;
      const Vec2d p = a + (b - a) * (da / (da - db));
      if (roof.planes[i].at(p) <= least(roof.planes, p) + 1e-6) bends.push_back(da / (da - db));
    }
  std::sort(bends.begin(), bends.end());
  std::vector<Vec3d> top;
  for (const double t : bends) {
    const Vec2d p = t == 0 ? a : t == 1 ? b : snapped(a + (b - a) * t);
    if (top.empty() || Vec2d(top.back()) != p) top.emplace_back(p, least(roof.planes, p));
  }
  return top;
}

}  // namespace manzana

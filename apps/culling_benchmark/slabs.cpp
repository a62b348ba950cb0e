#include "apps/culling_benchmark/slabs.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace manzana::culling_benchmark {
namespace {

using culling::FrustumD;
using culling::PlaneD;

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kFlat = 1e-14;  // a slope that is none: a ray lies in its own face, and only rounding says otherwise

/// The body: the hull of corners, and for an infinite view of rays from them. Relative to the eye.
struct Body {
  std::vector<Vec3d> corners, rays, edges;
};

Body body_of(const FrustumD& f) {
  const PlaneD& near = f.planes[culling::kNear];
  Body body;
  for (const auto& [a, b] : {std::pair{culling::kLeft, culling::kBottom}, std::pair{culling::kRight, culling::kBottom},
                             std::pair{culling::kRight, culling::kTop}, std::pair{culling::kLeft, culling::kTop}}) {
    const Vec3d along = glm::cross(f.planes[a].normal, f.planes[b].normal);
    const Vec3d edge = along / glm::dot(along, near.normal);  // to depth 1
    body.edges.push_back(edge);
    body.corners.push_back(edge * -near.offset);
    if (f.count > culling::kFar)
      body.corners.push_back(edge * f.planes[culling::kFar].offset);
    else
      body.rays.push_back(glm::normalize(edge));
  }
  body.edges.push_back(glm::cross(near.normal, f.planes[culling::kTop].normal));
  body.edges.push_back(glm::cross(near.normal, f.planes[culling::kRight].normal));
  return body;
}

SlabD measure(const Body& body, const Vec3d& direction) {
  SlabD slab{direction, kInf, -kInf};
  for (const Vec3d& corner : body.corners) {
    slab.low = std::min(slab.low, glm::dot(direction, corner));
    slab.high = std::max(slab.high, glm::dot(direction, corner));
  }
  for (const Vec3d& ray : body.rays) {
    const double slope = glm::dot(direction, ray);
    if (slope > kFlat) slab.high = kInf;
    if (slope < -kFlat) slab.low = -kInf;
  }
  return slab;
}

}  // namespace

std::vector<SlabD> face_slabs(const FrustumD& frustum) {
  std::vector<SlabD> slabs;
  for (int k = 0; k < frustum.count; ++k) {
    const PlaneD& plane = frustum.planes[static_cast<std::size_t>(k)];
    slabs.push_back({plane.normal, -plane.offset, kInf});
  }
  return slabs;
}

std::vector<SlabD> all_slabs(const FrustumD& frustum) {
  std::vector<SlabD> slabs = face_slabs(frustum);
  const Body body = body_of(frustum);
  const auto add = [&](const Vec3d& direction) {
    const double length = glm::length(direction);
    if (length > kFlat) slabs.push_back(measure(body, direction / length));
  };
  const std::array<Vec3d, 3> box_axes{Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)};
  for (const Vec3d& axis : box_axes) add(axis);
  for (const Vec3d& axis : box_axes)
    for (const Vec3d& edge : body.edges) add(glm::cross(axis, edge));
  return slabs;
}

}  // namespace manzana::culling_benchmark

#include "scenegraph/import/street_faces.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

namespace manzana {
namespace {

Geometry lines_of(const Geos& geos, const StreetGraph& graph) {
  std::vector<Geometry> lines;
  std::vector<Vec2d> plan;
  for (std::uint32_t e : enclosing_edges(graph)) {
    plan.assign(graph.edges[e].points.begin(), graph.edges[e].points.end());
    if (Geometry line = geos.line(plan)) lines.push_back(std::move(line));
  }
  return geos.collection(GEOS_MULTILINESTRING, std::move(lines));
}

// The noder refuses where rounding keeps it from ending; the overlay behind the union, slower, then snaps.
Geometry noded(const Geos& geos, const Geometry& lines) {
  if (Geometry network = geos.owned(GEOSNode_r(geos.handle(), lines.get()))) return network;
  return geos.owned(GEOSUnaryUnion_r(geos.handle(), lines.get()));
}

std::vector<Polygon> polygonized(const Geos& geos, const StreetGraph& graph) {
  const Geometry lines = lines_of(geos, graph);
  if (!lines || GEOSisEmpty_r(geos.handle(), lines.get()) != 0) return {};
  const Geometry network = noded(geos, lines);
  if (!network) return {};
  const std::array<const GEOSGeometry*, 1> parts{network.get()};
  const Geometry faces = geos.owned(GEOSPolygonize_r(geos.handle(), parts.data(), 1));
  return geos.polygons(faces.get());
}

bool before(const StreetFace& a, const StreetFace& b) {
  const Vec2d &p = a.centroid.center, &q = b.centroid.center;
  return std::tie(p.x, p.y, a.centroid.area) < std::tie(q.x, q.y, b.centroid.area);
}

struct Hit {
  const Geos& geos;
  const std::vector<const GEOSPreparedGeometry*>& prepared;
  const GEOSGeometry* point;
  std::uint32_t first = kNoFace;
};

void try_face(void* item, void* data) {
  const std::uint32_t face = *static_cast<const std::uint32_t*>(item);
  Hit& hit = *static_cast<Hit*>(data);
  if (face < hit.first && GEOSPreparedIntersects_r(hit.geos.handle(), hit.prepared[face], hit.point) == 1)
    hit.first = face;
}

}  // namespace

std::vector<std::uint32_t> enclosing_edges(const StreetGraph& graph) {
  std::vector<std::uint32_t> degree(graph.junctions.size(), 0), todo, result;
  std::vector<bool> kept(graph.edges.size());
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    kept[e] = carries_traffic(graph.streets[graph.edges[e].street].kind);
    if (kept[e]) ++degree[graph.edges[e].from], ++degree[graph.edges[e].to];
  }
  for (std::uint32_t j = 0; j < degree.size(); ++j)
    if (degree[j] == 1) todo.push_back(j);
  while (!todo.empty()) {
    const std::uint32_t end = todo.back();
    todo.pop_back();
    for (std::uint32_t e : graph.junctions[end].edges) {
      if (!kept[e] || degree[end] != 1) continue;
      kept[e] = false;
      const std::uint32_t other = graph.edges[e].from == end ? graph.edges[e].to : graph.edges[e].from;
      --degree[end];
      if (--degree[other] == 1) todo.push_back(other);
    }
  }
  for (std::uint32_t e = 0; e < kept.size(); ++e)
    if (kept[e]) result.push_back(e);
  return result;
}

StreetFaces::StreetFaces(const StreetGraph& graph) {
  for (Polygon& shape : polygonized(geos_, graph)) {
    const Centroid center = centroid(shape);
    const PlanBox box = box_of(shape.outer);
    faces_.push_back({std::move(shape), center, box});
  }
  std::sort(faces_.begin(), faces_.end(), before);
  make_index();
}

void StreetFaces::make_index() {
  const GEOSContextHandle_t handle = geos_.handle();
  if (faces_.empty()) return;
  rows_.resize(faces_.size());
  std::iota(rows_.begin(), rows_.end(), 0U);
  tree_ = GEOSSTRtree_create_r(handle, 10);
  for (std::uint32_t i = 0; i < faces_.size(); ++i) {
    shapes_.push_back(geos_.polygon(faces_[i].shape));
    prepared_.push_back(GEOSPrepare_r(handle, shapes_[i].get()));
    GEOSSTRtree_insert_r(handle, tree_, shapes_[i].get(), &rows_[i]);
  }
}

StreetFaces::~StreetFaces() {
  if (tree_ != nullptr) GEOSSTRtree_destroy_r(geos_.handle(), tree_);
  for (const GEOSPreparedGeometry* p : prepared_) GEOSPreparedGeom_destroy_r(geos_.handle(), p);
}

std::uint32_t StreetFaces::locate(const Vec2d& p) const {
  if (tree_ == nullptr) return kNoFace;
  const Geometry point = geos_.owned(GEOSGeom_createPointFromXY_r(geos_.handle(), p.x, p.y));
  Hit hit{geos_, prepared_, point.get()};
  GEOSSTRtree_query_r(geos_.handle(), tree_, point.get(), try_face, &hit);
  return hit.first;
}

}  // namespace manzana

#include "scenegraph/export/geopackage.h"

#include <unistd.h>

#include <cmath>
#include <glm/gtc/packing.hpp>
#include <stdexcept>

#include "foliage/import/species.h"
#include "scenegraph/export/geopackage_file.h"
#include "scenegraph/export/tile_content.h"
#include "scenegraph/import/geos.h"

namespace manzana {
namespace {

using Value = GeopackageLayer::Value;
using Columns = std::vector<GeopackageLayer::Column>;
using Path = std::filesystem::path;

class Writer {
 public:
  Writer(const Scene& scene, GeopackageFile& file, const std::function<void(std::string_view, double)>& progress)
      : scene_(scene),
        progress_(progress),
        blocks_(file, "blocks", "MULTIPOLYGON",
                Columns{{"block", "INTEGER"},
                        {"buildings", "INTEGER"},
                        {"trees", "INTEGER"},
                        {"low_m", "DOUBLE"},
                        {"high_m", "DOUBLE"},
                        {"radius_m", "DOUBLE"}}),
        buildings_(file, "buildings", "MULTIPOLYGON",
                   Columns{{"id", "TEXT"},
                           {"source_id", "TEXT"},
                           {"name", "TEXT"},
                           {"class", "TEXT"},
                           {"height", "DOUBLE"},
                           {"block", "INTEGER"}}),
        trees_(file, "trees", "POINT",
               Columns{{"source_id", "TEXT"},
                       {"species", "TEXT"},
                       {"height", "DOUBLE"},
                       {"crown", "DOUBLE"},
                       {"block", "INTEGER"}}) {}

  GeopackageWritten run() {
    for (std::uint32_t block = 0; block < scene_.blocks.size(); ++block) {
      add_block(block);
      if (progress_ && (block % 16 == 0 || block + 1 == scene_.blocks.size()))
        progress_("layers", static_cast<double>(block + 1) / static_cast<double>(scene_.blocks.size()));
    }
    for (GeopackageLayer* layer : {&blocks_, &buildings_, &trees_}) layer->finish();
    return {blocks_.rows(), buildings_.rows(), trees_.rows()};
  }

 private:
  // Degrees near those of the anchor: a city on the antimeridian stays in one piece.
  Vec2d degrees(const BlockFrame& frame, const Vec2d& plan) const {
    const GeoPoint place = scene_.frame.to_geo(frame.to_local({plan.x, plan.y, 0}));
    const double anchor = scene_.frame.anchor().lon_deg;
    return {anchor + std::remainder(place.lon_deg - anchor, 360.0), place.lat_deg};
  }

  std::vector<GeoPolygon> in_degrees(const BlockFrame& frame, const GEOSGeometry* shape) const {
    std::vector<GeoPolygon> all;
    const auto ring_of = [&](const std::vector<Vec2d>& ring) {
      GeoRing out;
      for (const Vec2d& p : ring) out.push_back(degrees(frame, p));
      return out;
    };
    for (const Polygon& polygon : geos_.polygons(shape)) {
      GeoPolygon& out = all.emplace_back(GeoPolygon{ring_of(polygon.outer)});
      for (const auto& hole : polygon.holes) out.push_back(ring_of(hole));
    }
    return all;
  }

  void add_block(std::uint32_t block) {
    const culling::ObjectRun objects = scene_.tree.block_objects[block];
    const culling::ObjectRun buildings = scene_.buildings.table.rows(objects), trees = scene_.trees.table.rows(objects);
    const auto key = static_cast<std::int64_t>(block);
    add_outline(block, static_cast<std::int64_t>(buildings.last - buildings.first),
                static_cast<std::int64_t>(trees.last - trees.first));
    for (std::uint32_t i = buildings.first; i < buildings.last; ++i) add_building(block, i);
    for (std::uint32_t i = trees.first; i < trees.last; ++i) {
      const TreeInstance& tree = scene_.trees.instances[i];
      const std::string species = tree.plant < kPlantSpecies ? std::string(foliage::kSpeciesNames[tree.plant]) : "";
      trees_.add(degrees(scene_.blocks[block], Vec2(tree.position)),
                 {source_of(scene_, scene_.trees.table, i), species, static_cast<double>(tree.height_m),
                  2.0 * static_cast<double>(tree.crown_radius_m), key});
    }
  }

  // The hull in plan of all that stands and lies there, with the bounds that the BqR-Tree has of it.
  void add_outline(std::uint32_t block, std::int64_t buildings, std::int64_t trees) {
    std::vector<Vec2d> points;
    culling::BoxD box;
    const BlockFrame& frame = scene_.blocks[block];
    const auto add = [&](const Vec3d& p) {
      points.emplace_back(p);
      box = merge(box, p);
    };
    const culling::ObjectRun objects = scene_.tree.block_objects[block];
    for (const MeshLayer* layer : {&scene_.buildings, &scene_.surfaces}) {
      const auto [first, last] = layer->table.rows(objects);
      for (std::uint32_t i = layer->index_first[first]; i < layer->index_first[last]; ++i)
        add(Vec3d(layer->mesh.vertices[layer->mesh.indices[i]].position));
    }
    const auto [first, last] = scene_.trees.table.rows(objects);
    for (std::uint32_t i = first; i < last; ++i) {
      const TreeInstance& tree = scene_.trees.instances[i];
      const auto r = static_cast<double>(tree.crown_radius_m);
      for (const Vec3d& corner : {Vec3d(-r, -r, 0), Vec3d(r, -r, 0), Vec3d(r, r, 0), Vec3d(-r, r, tree.height_m)})
        add(Vec3d(tree.position) + corner);
    }
    if (points.size() < 3) return;
    const Geometry cloud = geos_.line(points);
    const Geometry hull = geos_.owned(cloud ? GEOSConvexHull_r(geos_.handle(), cloud.get()) : nullptr);
    const auto shape = hull ? in_degrees(frame, hull.get()) : std::vector<GeoPolygon>();
    if (shape.empty()) return;
    blocks_.add(shape, {static_cast<std::int64_t>(block), buildings, trees, box.min.z, box.max.z,
                        enclosing_sphere(box).radius});
  }

  // What is seen of it from above.
  void add_building(std::uint32_t block, std::uint32_t index) {
    constexpr double kLeast = 1e-4;  // m2, in plan: smaller triangles stand upright
    const StoredMesh& mesh = scene_.buildings.mesh;
    std::vector<Geometry> triangles;
    const MeshRow row = row_of(scene_.buildings, index);
    for (std::uint32_t i = row.index_first; i + 2 < row.index_last; i += 3) {
      const auto at = [&](std::uint32_t k) { return Vec2d(Vec2(mesh.vertices[mesh.indices[i + k]].position)); };
      const Vec2d a = at(1) - at(0), b = at(2) - at(0);
      if (a.x * b.y - a.y * b.x > 2 * kLeast) triangles.push_back(geos_.polygon({{at(0), at(1), at(2)}, {}}));
    }
    const Geometry all = geos_.collection(GEOS_MULTIPOLYGON, std::move(triangles));
    const Geometry shape = geos_.owned(all ? GEOSUnaryUnion_r(geos_.handle(), all.get()) : nullptr);
    const auto polygons = shape ? in_degrees(scene_.blocks[block], shape.get()) : std::vector<GeoPolygon>();
    if (polygons.empty()) return;
    const BuildingRow facts = building_row(scene_, index);
    buildings_.add(polygons, {facts.id, facts.source, facts.name, facts.kind, static_cast<double>(facts.height_m),
                              static_cast<std::int64_t>(block)});
  }

  const Scene& scene_;
  const std::function<void(std::string_view, double)>& progress_;
  const Geos geos_;
  GeopackageLayer blocks_, buildings_, trees_;
};

}  // namespace

GeopackageWritten write_geopackage(const Scene& scene, const Path& file,
                                   const std::function<void(std::string_view, double)>& progress) {
  Path part = file;
  part += ".part" + std::to_string(getpid());
  std::error_code ignored;
  std::filesystem::remove(part, ignored);
  try {
    GeopackageWritten written;
    {
      GeopackageFile package(part);
      written = Writer(scene, package, progress).run();
      package.finish();
    }
    std::filesystem::rename(part, file);
    return written;
  } catch (const std::filesystem::filesystem_error& error) {
    std::filesystem::remove(part, ignored);
    throw std::runtime_error(file.string() + ": cannot be written: " + error.code().message());
  } catch (const std::exception& error) {
    std::filesystem::remove(part, ignored);
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

}  // namespace manzana

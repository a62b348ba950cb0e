// Blocks have frames of their own: to move a city is to move these, and no vertex changes.
#include <algorithm>
#include <chrono>
#include <iterator>
#include <unordered_map>

#include "scenegraph/earth_centred.h"
#include "scenegraph/import/loose_city.h"

namespace manzana {
namespace {

constexpr double kReach = 300e3;  // metres from the frame's anchor, as for features

/// From one frame into another's.
struct RigidMove {
  Mat3d turn{1.0};
  Vec3d by{0, 0, 0};
  Vec3d operator()(const Vec3d& p) const { return turn * p + by; }
};

bool same_place(const GeoPoint& a, const GeoPoint& b) {
  return a.lat_deg == b.lat_deg && a.lon_deg == b.lon_deg && a.height_m == b.height_m;
}

RigidMove move_between(const LocalFrame& from, const LocalFrame& to) {
  if (same_place(from.anchor(), to.anchor())) return {};  // to the bit
  const Mat4d a = local_to_ecef(from), b = local_to_ecef(to);
  const Mat3d back = glm::transpose(Mat3d(b));
  return {back * Mat3d(a), back * (Vec3d(a[3]) - Vec3d(b[3]))};
}

class Loosener {
 public:
  Loosener(const Imported& city, const LocalFrame& frame)
      : scene_(city.scene), move_(move_between(city.scene.frame, frame)) {
    out_.frame = frame;
    out_.issues = city.issues;
  }

  LooseCity run() {
    for (const BlockFrame& block : scene_.blocks) out_.blocks.push_back({move_(block.origin), move_.turn * block.axes});
    for (std::uint32_t b = 0; b < out_.blocks.size(); ++b) {
      const culling::ObjectRun run = scene_.tree.block_objects[b];
      for (std::uint32_t object = run.first; object < run.last; ++object) take(b, object);
    }
    out_.traffic = scene_.traffic;
    out_.traffic.points = {};
    for (const LanePoint& point : scene_.traffic.points)
      out_.traffic.points.own().push_back({move_(point.position), point.s, move_.turn * point.forward});
    out_.attributes = scene_.attributes;
    out_.attributes.row_of_object.clear();
    out_.pictures = scene_.pictures;
    out_.attribution = scene_.attribution;
    return std::move(out_);
  }

 private:
  void take(std::uint32_t block, std::uint32_t object) {
    const auto rows = [&](const LayerTable& table) { return table.rows({object, object + 1}); };
    if (const auto row = rows(scene_.buildings.table); row.first < row.last)
      out_.buildings.push_back(mesh_object(scene_.buildings, row.first, block, object, kBuildings, kBuilding));
    if (const auto row = rows(scene_.surfaces.table); row.first < row.last)
      out_.surfaces.push_back(mesh_object(scene_.surfaces, row.first, block, object, kSurface, kSurface));
    if (const auto row = rows(scene_.trees.table); row.first < row.last) take_tree(row.first, block, object);
  }

  /// What a file says of an object's class, as far as it is one of its layer.
  culling::ClassMask kind_of(std::uint32_t object, culling::ClassMask layer, culling::ClassMask otherwise) const {
    const auto& classes = scene_.tree.classes;
    const auto kind = static_cast<culling::ClassMask>(classes.empty() ? 0 : classes[object] & layer);
    return kind != 0 ? kind : otherwise;
  }
  std::uint32_t attributes_of(std::uint32_t object) const {
    const auto& rows = scene_.attributes.row_of_object;
    return rows.empty() ? 0 : rows[object];
  }

  MeshObject mesh_object(const MeshLayer& layer, std::uint32_t row, std::uint32_t block, std::uint32_t object,
                         culling::ClassMask kinds, culling::ClassMask otherwise) {
    MeshObject out;
    out.mesh = cut(layer, row);
    for (std::size_t level = 0; level < kMeshLevels; ++level) out.levels[level] = cut(layer.levels[level], row);
    out.box = bounds(out.mesh, out_.blocks[block]);
    out.block = block;
    out.attributes = attributes_of(object);
    out.kind = kind_of(object, kinds, otherwise);
    return out;
  }

  void take_tree(std::uint32_t row, std::uint32_t block, std::uint32_t object) {
    TreeObject out;
    out.instance = scene_.trees.instances[row];
    out.instance.block = block;
    out.box = bounds(out.instance, out_.blocks[block]);
    out.attributes = attributes_of(object);
    out.kind = kind_of(object, kTrees, kTree);
    out_.trees.push_back(out);
  }

  /// One row's, its vertices in the order in which they are used.
  CityMesh cut(const MeshRows& rows, std::uint32_t row) {
    CityMesh out;
    if (rows.index_first.empty()) return out;
    place_.clear();
    for (std::uint32_t i = rows.index_first[row]; i < rows.index_first[row + 1]; ++i) {
      const std::uint32_t vertex = rows.mesh.indices[i];
      const auto [at, fresh] = place_.try_emplace(vertex, static_cast<std::uint32_t>(out.vertices.size()));
      if (fresh) out.vertices.push_back(rows.mesh.vertices[vertex]), wear(out, texture_of(rows.mesh, vertex));
      out.indices.push_back(at->second);
    }
    return out;
  }

  const Scene& scene_;
  RigidMove move_;
  LooseCity out_;
  std::unordered_map<std::uint32_t, std::uint32_t> place_;  ///< of a row's vertices
};

void join(Traffic& into, Traffic&& more, std::uint32_t blocks) {
  const auto end = [](const auto& column) { return static_cast<std::uint32_t>(column.size()); };
  const std::uint32_t halves = end(into.halves), points = end(into.points), pieces = end(into.pieces),
                      circuits = end(into.circuits), cars = end(into.offsets);
  for (HalfStreet& half : more.halves) {
    half.block += blocks, half.circuit += circuits;
    half.first_point += points, half.last_point += points;
    half.first_piece += pieces, half.last_piece += pieces;
  }
  for (Circuit& circuit : more.circuits) {
    circuit.first_half += halves, circuit.last_half += halves;
    circuit.first_car += cars, circuit.last_car += cars;
  }
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(into.halves, more.halves), append(into.points.own(), more.points), append(into.pieces, more.pieces);
  append(into.circuits, more.circuits), append(into.offsets, more.offsets);
}

/// Buildings alone wear pictures.
void join_pictures(LooseCity& into, LooseCity& more) {
  const std::uint32_t textures = join(into.pictures, std::move(more.pictures));
  const auto move = [&](CityMesh& mesh) {
    for (std::uint32_t& texture : mesh.textures) texture += texture > 0 ? textures : 0;
  };
  for (MeshObject& object : more.buildings) {
    move(object.mesh);
    std::ranges::for_each(object.levels, move);
  }
}

void each_object(LooseCity& city, auto&& visit) {
  for (MeshObject& object : city.buildings) visit(object.block, object.attributes);
  for (MeshObject& object : city.surfaces) visit(object.block, object.attributes);
  for (TreeObject& object : city.trees) visit(object.instance.block, object.attributes);
}

/// Texts that both have are kept once.
Attributes join_attributes(LooseCity& a, LooseCity& b) {
  AttributeWriter writer(!a.attributes.rows.empty() || !b.attributes.rows.empty());
  for (LooseCity* city : {&a, &b})
    each_object(*city, [&](std::uint32_t, std::uint32_t& row) {
      row = city->attributes.rows.empty() ? 0 : writer.row(city->attributes.row(row));
    });
  return writer.take();
}

}  // namespace

LooseCity loosened(const Imported& city, const LocalFrame& frame) { return Loosener(city, frame).run(); }

void join(LooseCity& into, LooseCity more) {
  const auto blocks = static_cast<std::uint32_t>(into.blocks.size());
  into.attributes = join_attributes(into, more);
  join_pictures(into, more);
  each_object(more, [&](std::uint32_t& block, std::uint32_t) { block += blocks; });
  const auto append = [](auto& to, auto& from) { std::move(from.begin(), from.end(), std::back_inserter(to)); };
  append(into.blocks, more.blocks), append(into.buildings, more.buildings), append(into.surfaces, more.surfaces);
  append(into.trees, more.trees), append(into.issues, more.issues);
  join(into.traffic, std::move(more.traffic), blocks);
  if (!more.attribution.empty() && into.attribution != more.attribution)
    into.attribution += (into.attribution.empty() ? "" : "; ") + more.attribution;
}

Imported merge(std::vector<Imported> cities) {
  if (cities.size() == 1) return std::move(cities.front());
  const auto start = std::chrono::steady_clock::now();
  const LocalFrame frame = cities.at(0).scene.frame;
  LooseCity all;
  all.frame = frame;
  ImportReport sum;
  for (Imported& city : cities) {
    const RigidMove move = move_between(city.scene.frame, frame);
    if (glm::length(move.by) > kReach) {
      all.issues.push_back({"another source", std::to_string(city.scene.tree.objects()) +
                                                  " objects are farther than 300 km from the first; left out"});
      continue;
    }
    join(all, loosened(city, frame));
    sum.fallback_blocks += city.report.fallback_blocks, sum.fallback_objects += city.report.fallback_objects;
    sum.seconds += city.report.seconds;
    city.scene = Scene();  // its memory, before more is needed
  }
  Imported merged = assemble(std::move(all));
  merged.report.fallback_blocks = sum.fallback_blocks, merged.report.fallback_objects = sum.fallback_objects;
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  merged.report.seconds = sum.seconds + taken.count();
  return merged;
}

}  // namespace manzana

// The order of work: streets become a graph, everything gets a centre, centres fall into blocks, blocks get frames,
// objects get meshes in them, meshes give bounds; the rest is assemble().
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>

#include "culling/hash.h"
#include "scenegraph/import/blocks.h"
#include "scenegraph/import/build_traffic.h"
#include "scenegraph/import/building_levels.h"
#include "scenegraph/import/geos.h"
#include "scenegraph/import/import.h"
#include "scenegraph/import/loose_city.h"
#include "scenegraph/import/meshes.h"
#include "scenegraph/import/paved_ground.h"
#include "scenegraph/import/surface_piece.h"
#include "scenegraph/import/terrain.h"

namespace manzana {
namespace {

using culling::BoxD;

/// From its lowest to its highest point; 0 without any.
double height_of(const CityMesh& mesh) {
  const auto [low, high] =
      std::ranges::minmax_element(mesh.vertices, {}, [](const CityVertex& v) { return v.position.z; });
  return low == mesh.vertices.end() ? 0 : static_cast<double>(high->position.z) - static_cast<double>(low->position.z);
}

class Builder {
 public:
  Builder(CityFeatures features, const Terrain& terrain, const ImportOptions& options, const Progress& progress)
      : f_(std::move(features)), terrain_(terrain), options_(options), progress_(progress) {}

  Imported run() {
    const auto start = std::chrono::steady_clock::now();
    plan();
    drive();
    make_meshes();
    drop_empty();
    count_fallback();
    Imported result = assemble({f_.frame, std::move(frames_), std::move(buildings_), std::move(surfaces_),
                                std::move(trees_), std::move(traffic_), f_.attributes.take(), std::move(f_.pictures),
                                std::move(f_.attribution), std::move(f_.issues)});
    tell(1);
    result.report.fallback_blocks = fallback_blocks_, result.report.fallback_objects = fallback_objects_;
    result.report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
  }

 private:
  /// `done`: about the share of the time that is over by then, for a city with woods and traffic.
  void tell(double done) const {
    if (progress_) progress_("building", done);
  }

  // Streets, scattered trees, pieces of ground; then the blocks of all centres: buildings, constructions, trees,
  // plants, pieces, in this order.
  void plan() {
    tell(0);
    graph_ = build_street_graph(std::move(f_.streets), f_.issues);
    f_.streets = graph_.streets;
    tell(0.05);
    const std::vector<TreeFeature> scattered = scatter_trees(f_, options_.seed);
    f_.trees.insert(f_.trees.end(), scattered.begin(), scattered.end());
    tell(0.25);
    const StreetFaces faces(graph_);
    for (AreaFeature& area : paved_ground(faces, f_.buildings)) f_.areas.push_back(std::move(area));
    pieces_ = area_pieces(f_.areas, f_.issues);
    cover_terrain();
    for (SurfacePiece& piece : street_pieces(graph_, f_.issues)) pieces_.push_back(std::move(piece));
    tell(0.4);
    BlockOptions options;
    options.left_hand_traffic = f_.left_hand_traffic;
    plan_ = find_blocks(graph_, faces, centers(), options);
    frames_.reserve(plan_.blocks.size());
    for (const BlockGround& ground : plan_.blocks) frames_.push_back(block_frame(f_.frame, ground.center));
  }

  // Below all that is laid on it: grass, where a terrain is known.
  void cover_terrain() {
    if (terrain_.level()) return;
    const Vec2d low = terrain_.origin, high = terrain_.end();
    const Polygon all{{low, {high.x, low.y}, high, {low.x, high.y}}, {}};
    append_area(pieces_, Geos(), all, {"terrain", Material::grass, 0}, f_.issues);
  }

  std::vector<Vec2d> centers() const {
    std::vector<Vec2d> result;
    result.reserve(first_piece() + pieces_.size());
    for (const BuildingFeature& building : f_.buildings) result.push_back(middle(building.footprint.outer));
    for (const ConstructionFeature& work : f_.constructions) result.push_back(middle(work.points));
    for (const TreeFeature& tree : f_.trees) result.push_back(tree.position);
    for (const PlacedPlant& plant : f_.plants) result.emplace_back(plant.position);
    for (const SurfacePiece& piece : pieces_) result.push_back(piece.center);
    return result;
  }
  std::size_t first_tree() const { return f_.buildings.size() + f_.constructions.size(); }
  std::size_t first_piece() const { return first_tree() + f_.trees.size() + f_.plants.size(); }
  // Of the bounding box: the centre that decides the block need not be the centroid.
  template <class Points>
  static Vec2d middle(const Points& points) {
    if (points.empty()) return {0, 0};
    Vec2d low(points[0]), high(points[0]);
    for (const auto& p : points) {
      low = glm::min(low, Vec2d(p));
      high = glm::max(high, Vec2d(p));
    }
    return low + (high - low) / 2.0;
  }

  void drive() {
    tell(0.45);
    traffic_ = build_traffic(
        f_.frame, graph_, plan_.half_streets, static_cast<std::uint32_t>(plan_.blocks.size()),
        {.cars = options_.cars, .left_hand = f_.left_hand_traffic, .seed = options_.seed, .terrain = &terrain_});
  }

  void make_meshes() {
    tell(0.8);
    buildings_.resize(first_tree());
    std::vector<std::vector<Issue>> issues(buildings_.size());
    tbb::parallel_for(std::size_t{0}, buildings_.size(), [&](std::size_t i) {
      MeshObject& object = buildings_[i];
      object.block = plan_.of[i];
      object.attributes =
          i < f_.buildings.size() ? f_.buildings[i].attributes : f_.constructions[i - f_.buildings.size()].attributes;
      const Site site{f_.frame, frames_[object.block], &terrain_};
      const std::size_t own = i - f_.buildings.size();
      if (i < f_.buildings.size())
        append_building(object.mesh, site, f_.buildings[i], issues[i]);
      else
        append_construction(object.mesh, site, f_.constructions[own], issues[i]),
            object.levels = levels_of(object.mesh);
      object.kind = building_class(height_of(object.mesh));
      object.box = bounds(object.mesh, frames_[object.block]);
    });
    for (auto& list : issues) std::move(list.begin(), list.end(), std::back_inserter(f_.issues));
    tell(0.9);
    surfaces_.resize(pieces_.size());
    tbb::parallel_for(std::size_t{0}, pieces_.size(), [&](std::size_t i) {
      MeshObject& object = surfaces_[i];
      object.block = plan_.of[first_piece() + i];
      object.attributes = pieces_[i].attributes;
      object.mesh = lay(std::move(pieces_[i]), {f_.frame, frames_[object.block], &terrain_});
      object.box = bounds(object.mesh, frames_[object.block]);
    });
    plant_all();
  }

  void plant_all() {
    trees_.reserve(f_.trees.size() + f_.plants.size());
    for (std::size_t i = 0; i < f_.trees.size(); ++i) plant(placed(f_.trees[i], i), f_.trees[i].attributes);
    for (const PlacedPlant& placed : f_.plants) plant(placed, 0);
  }

  PlacedPlant placed(const TreeFeature& tree, std::size_t i) const {
    return {.position = Vec3d(tree.position, 0),
            .height = tree.height,
            .crown_radius = tree.crown_radius,
            .yaw = 6.283185307179586 * hash_unit(options_.seed + 21, i),
            .plant = static_cast<std::uint16_t>(tree.species.value_or(plain_species(tree.kind)))};
  }

  void plant(const PlacedPlant& placed, std::uint32_t attributes) {
    const std::size_t i = trees_.size();
    const std::uint32_t block = plan_.of[first_tree() + i];
    const Vec3d foot = ground_point(f_.frame, frames_[block], Vec2d(placed.position),
                                    placed.position.z + terrain_.at(Vec2d(placed.position)));
    TreeObject& object = trees_.emplace_back();
    object.instance = {.position = foot,
                       .height_m = static_cast<float>(placed.height),
                       .crown_radius_m = static_cast<float>(placed.crown_radius),
                       .yaw = static_cast<float>(placed.yaw),
                       .block = block,
                       .plant = placed.plant,
                       .tint = static_cast<std::uint8_t>(hash_bits(options_.seed + 22, i) & 255u)};
    object.box = bounds(object.instance, frames_[block]);
    object.attributes = attributes;
    if (placed.plant < kPlantSpecies)
      object.kind = tree_class(kind_of(static_cast<PlantSpecies>(placed.plant)), placed.height);
  }

  void drop_empty() {
    tell(0.95);
    const auto empty = [](const MeshObject& object) { return object.mesh.indices.empty(); };
    std::erase_if(buildings_, empty);
    std::erase_if(surfaces_, empty);
  }

  // Objects in blocks that are no face of the street network, before anything is moved away.
  void count_fallback() {
    const auto see = [&](std::uint32_t block) { fallback_objects_ += plan_.blocks[block].fallback ? 1 : 0; };
    for (const MeshObject& object : buildings_) see(object.block);
    for (const MeshObject& object : surfaces_) see(object.block);
    for (const TreeObject& object : trees_) see(object.instance.block);
    fallback_blocks_ = static_cast<std::size_t>(std::ranges::count_if(plan_.blocks, &BlockGround::fallback));
  }

  CityFeatures f_;
  const Terrain& terrain_;
  const ImportOptions& options_;
  const Progress& progress_;
  Traffic traffic_;
  std::size_t fallback_blocks_ = 0, fallback_objects_ = 0;
  StreetGraph graph_;
  BlockPlan plan_;
  std::vector<BlockFrame> frames_;
  std::vector<SurfacePiece> pieces_;
  std::vector<MeshObject> buildings_, surfaces_;
  std::vector<TreeObject> trees_;
};

}  // namespace

Imported build_scene(CityFeatures features, const ImportOptions& options, const Progress& progress) {
  return build_scene(std::move(features), Terrain(), options, progress);
}

Imported build_scene(CityFeatures features, const Terrain& terrain, const ImportOptions& options,
                     const Progress& progress) {
  return Builder(std::move(features), terrain, options, progress).run();
}

}  // namespace manzana

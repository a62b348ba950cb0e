// Tiles from the BqR-Tree; contents side by side, each written as it is made; then volumes from the leaves up, since a
// tile's holds its children's; then tileset.json; then the folder gets its name.
#include "scenegraph/export/tiles.h"

#include <tbb/parallel_for.h>

#include <atomic>
#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "files/whole_file.h"
#include "files/whole_folder.h"
#include "scenegraph/earth_centred.h"
#include "scenegraph/export/glb.h"

namespace manzana {
namespace {

using culling::BoxD;
using culling::SphereD;
using Json = nlohmann::json;
using Path = std::filesystem::path;

std::array<Vec3d, 8> corners_of(const BoxD& box) {
  std::array<Vec3d, 8> corners;
  for (unsigned i = 0; i < 8; ++i)
    corners[i] = {(i & 1U) != 0 ? box.max.x : box.min.x, (i & 2U) != 0 ? box.max.y : box.min.y,
                  (i & 4U) != 0 ? box.max.z : box.min.z};
  return corners;
}

/// The files of a tile.
constexpr std::array<const char*, 2> kParts{"city", "trees"};

/// What is known of a tile besides Tile: its content's box in its frame; of a node, the sphere in it round that and
/// the children's volumes.
struct Bounds {
  BoxD content;
  SphereD sphere;
  std::array<bool, kParts.size()> written{};
};

/// Spheres of nodes: children come after their parents.
void find_spheres(const std::vector<Tile>& tiles, std::vector<Bounds>& bounds) {
  constexpr double kRoom = 1 + 1e-9;
  for (std::size_t t = tiles.size(); t-- > 0;) {
    const Tile& tile = tiles[t];
    if (tile.leaf) continue;
    std::vector<SphereD> inside;
    const auto add = [&](const BoxD& box, const BlockFrame& frame) {
      if (box.empty()) return;
      for (const Vec3d& p : corners_of(box)) inside.push_back({tile.frame.to_block(frame.to_local(p)), 0});
    };
    add(bounds[t].content, tile.frame);
    for (const std::uint32_t child : tile.children) {
      const SphereD& sphere = bounds[child].sphere;
      if (tiles[child].leaf)
        add(bounds[child].content, tiles[child].frame);
      else if (!sphere.empty())
        inside.push_back({tile.frame.to_block(tiles[child].frame.to_local(sphere.center)), sphere.radius * kRoom});
    }
    bounds[t].sphere = culling::enclosing_sphere(inside);
  }
}

Json column_major(const Mat3d& axes, const Vec3d& origin) {
  Json all = Json::array();
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) all.push_back(axes[c][r]);
    all.push_back(0.0);
  }
  for (int r = 0; r < 3; ++r) all.push_back(origin[r]);
  all.push_back(1.0);
  return all;
}

Json volume_of(const Tile& tile, const Bounds& bounds) {
  if (!tile.leaf) {
    const SphereD& s = bounds.sphere;
    return {{"sphere", {s.center.x, s.center.y, s.center.z, s.radius}}};
  }
  const Vec3d c = culling::center(bounds.content), h = bounds.content.max - c;
  return {{"box", {c.x, c.y, c.z, h.x, 0.0, 0.0, 0.0, h.y, 0.0, 0.0, 0.0, h.z}}};
}

std::string content_name(std::size_t tile, std::size_t part) {
  return "tiles/" + std::to_string(tile) + "-" + kParts[part] + ".glb";
}

class Writer {
 public:
  Writer(const Scene& scene, std::span<const foliage::PreparedPlant> plants,
         const std::function<void(std::string_view, double)>& progress)
      : scene_(scene), plants_(plants), progress_(progress), models_(plants) {}

  TilesWritten run(const Path& folder) {
    tiles_ = tile_tree(scene_);
    if (tiles_.empty()) throw std::runtime_error(folder.string() + ": there is nothing to write");
    bounds_.resize(tiles_.size());
    files::WholeFolder whole(folder);
    files::make_folder(whole.part() / "tiles");
    for (const TreeInstance& tree : scene_.trees.instances) stand_.insert(tree.plant);
    leaf_models_ = models_at(kLeafError);
    if (!stand_.empty()) files::make_folder(whole.part() / "plants");
    for (auto& [plant, model] : leaf_models_) {
      const std::string name = "plants/" + std::to_string(plant) + ".bin";
      model = share(std::move(model), "../" + name);
      write(whole.part() / name, model.bytes);
    }
    write_contents(whole.part());
    find_spheres(tiles_, bounds_);
    write(whole.part() / "tileset.json", tileset().dump(1));
    whole.finish();
    done_.tiles = tiles_.size();
    done_.trees = scene_.trees.table.size();
    done_.buildings = scene_.buildings.table.size();
    return done_;
  }

 private:
  TreeModels models_at(double error_m) const {
    TreeModels models;
    for (const std::uint16_t plant : stand_) models[plant] = {models_.at(plant, error_m), plants_[plant].name};
    return models;
  }

  void write_contents(const Path& folder) {
    std::atomic<std::size_t> next = 0;
    tbb::parallel_for(std::size_t{0}, tiles_.size(), [&](std::size_t t) {
      write_content(folder, t);
      const std::scoped_lock lock(mutex_);
      if (progress_) progress_("tiles", static_cast<double>(++next) / static_cast<double>(tiles_.size()));
    });
  }

  // The leaves share their models: all are of one error.
  void write_content(const Path& folder, std::size_t t) {
    const TileContent content = tile_content(scene_, tiles_[t], plants_);
    const bool own = !tiles_[t].leaf && !content.trees.empty();
    const TreeModels models = own ? models_at(tiles_[t].error_m) : TreeModels();
    const std::array<EncodedTile, kParts.size()> parts{
        encode_city(content, scene_.attribution),
        encode_trees(content, own ? models : leaf_models_, scene_.attribution)};
    for (std::size_t part = 0; part < parts.size(); ++part) {
      if (parts[part].glb.empty()) continue;
      bounds_[t].written[part] = true;
      bounds_[t].content = merge(bounds_[t].content, parts[part].box);
      write(folder / content_name(t, part), parts[part].glb);
    }
  }

  void write(const Path& file, const std::string& bytes) {
    files::write_whole(file, bytes);
    const std::scoped_lock lock(mutex_);
    done_.bytes += bytes.size();
    ++done_.files;
  }

  Json tileset() const {
    Json root = tile_json(0);
    const Mat4d ecef = local_to_ecef(scene_.frame);
    const BlockFrame& frame = tiles_[0].frame;
    root["transform"] = column_major(Mat3d(ecef) * frame.axes, Vec3d(ecef * Vec4d(frame.origin, 1)));
    return {{"asset", {{"version", "1.1"}, {"generator", "Manzana"}}},
            {"geometricError", bounds_[0].sphere.radius},
            {"root", std::move(root)}};
  }

  Json tile_json(std::uint32_t t) const {
    const Tile& tile = tiles_[t];
    Json json = {{"boundingVolume", volume_of(tile, bounds_[t])}, {"geometricError", tile.error_m}};
    if (t == 0) json["refine"] = "REPLACE";
    for (std::size_t part = 0; part < kParts.size(); ++part)
      if (bounds_[t].written[part]) json["contents"].push_back({{"uri", content_name(t, part)}});
    for (const std::uint32_t child : tile.children) {
      if (tiles_[child].leaf ? bounds_[child].content.empty() : bounds_[child].sphere.empty()) continue;
      Json& added = json["children"].emplace_back(tile_json(child));
      const BlockFrame& frame = tiles_[child].frame;
      added["transform"] =
          column_major(glm::transpose(tile.frame.axes) * frame.axes, tile.frame.to_block(frame.origin));
    }
    return json;
  }

  const Scene& scene_;
  std::span<const foliage::PreparedPlant> plants_;
  const std::function<void(std::string_view, double)>& progress_;
  PlantModels models_;
  std::set<std::uint16_t> stand_;  // plants
  TreeModels leaf_models_;
  std::vector<Tile> tiles_;
  std::vector<Bounds> bounds_;
  std::mutex mutex_;
  TilesWritten done_;
};

}  // namespace

TilesWritten write_tiles(const Scene& scene, std::span<const foliage::PreparedPlant> plants,
                         const std::filesystem::path& folder,
                         const std::function<void(std::string_view, double)>& progress) {
  return Writer(scene, plants, progress).run(folder);
}

}  // namespace manzana

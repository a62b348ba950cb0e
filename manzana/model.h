#pragma once
/// A city made ready for drawing: the first of two phases of loading, without GL, on any thread. It never changes, so
/// any number of views, on any threads, may draw it at once.
///   const auto model = Model::load("helsinki.osm.pbf", {}, progress);     // a thread of the host's
///   view.show(model);                                                      // manzana/view.h
/// Frame: L, metres, x east, y north, z up at the anchor. A host with other coordinates multiplies its view matrix, in
/// double, by what leads from L to them: local_to_ecef(), or its own projection of frame().to_geo().
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "foliage/prepared_plant.h"
#include "scenegraph/draw/renderer.h"
#include "scenegraph/import/import.h"
#include "scenegraph/nodes.h"

namespace manzana {

/// What is picked: 0 is nothing.
using FeatureId = std::uint32_t;

struct Feature {
  FeatureId id = 0;
  ObjectClass kind = kBuilding;
  culling::BoxD box;        ///< in L
  GeoPoint place;           ///< under the middle of the box
  AttributeRow attributes;  ///< what its file says of it; as long as the model
};

struct LoadOptions {
  std::uint64_t seed = 1;                 ///< of what is made up: scattered trees, cars, the built-in town
  int cars = -1;                          ///< how many; -1: by the length of the streets
  int threads = 1;                        ///< the calling one included; no others are started, or used, for 1
  bool trees = true;                      ///< else none are prepared, and none are drawn
  bool attributes = true;                 ///< else what files say of things is not kept
  std::filesystem::path orthophoto = {};  ///< laid over the ground (scenegraph/import/read_photo.h); empty: none
  /// Where prepared plants, and packs of far ones, are kept; none: they are not.
  std::optional<std::filesystem::path> plant_cache = {};
};

class Model {
 public:
  /// `city` as import_city takes it. Throws std::runtime_error ("FILE: what is wrong"). `progress` is called on the
  /// calling thread; what it throws ends the loading.
  static std::shared_ptr<const Model> load(const std::string& city, const LoadOptions& options,
                                           const Progress& progress = {});
  /// Of bytes that the host has read: "osm", "osm.gz", "osm.bz2" or "pbf". `name` is for messages.
  static std::shared_ptr<const Model> load(std::span<const char> bytes, const std::string& format,
                                           const std::string& name, const LoadOptions& options,
                                           const Progress& progress = {});

  const Scene& scene() const { return imported_.scene; }
  const LocalFrame& frame() const { return imported_.scene.frame; }
  const std::vector<Issue>& issues() const { return imported_.issues; }
  /// Must be shown with every picture, where it is not empty.
  const std::string& credits() const { return imported_.scene.attribution; }
  std::span<const foliage::PreparedPlant> plants() const { return plants_; }
  /// Where what is made of plants is kept; none: it is not.
  const std::optional<std::filesystem::path>& plant_cache() const { return plant_cache_; }
  Mat4d local_to_ecef() const;
  FeatureId features() const { return imported_.scene.tree.objects(); }
  /// 1 to features(); throws std::out_of_range.
  Feature feature(FeatureId id) const;

  /// For what a host puts into it; as many as one likes.
  std::shared_ptr<Nodes> new_nodes() const;

  /// Of parts that the host has made or changed itself. `plants`: by TreeInstance::plant. What neighbours hide of trees
  /// is found here, unless it is known: some seconds for 100 000 trees.
  Model(Imported imported, std::vector<foliage::PreparedPlant> plants,
        std::optional<std::filesystem::path> plant_cache = {});

 private:
  Imported imported_;
  std::vector<foliage::PreparedPlant> plants_;
  std::optional<std::filesystem::path> plant_cache_;
};

}  // namespace manzana

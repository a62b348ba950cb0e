#pragma once
/// camera, time -> what is seen: the middle of the way of the data, once a frame.
///   VisibleSets sets(scene);                                  // reserves once; no allocation afterwards
///   find_visible(scene, view, Structure::bqr, sets);
///   find_cars(scene, tick, sets);
///   for (ObjectRun run : sets.objects()) draw(scene.trees.table.rows(run));
#include <cstdint>
#include <span>
#include <vector>

#include "culling/cull.h"
#include "scenegraph/nodes.h"
#include "scenegraph/scene.h"

namespace manzana {

/// How objects are found: through the BqR-Tree, or not at all (everything is submitted), for comparison.
enum class Structure : std::uint8_t { bqr, none };

struct VisibleSets {
  explicit VisibleSets(const Scene& scene);
  /// Of the tree, rising, disjoint; LayerTable::rows makes a layer's rows of them.
  std::span<const culling::ObjectRun> objects() const {
    return kept ? std::span<const culling::ObjectRun>(kept_objects) : answer.objects().first(city_runs);
  }
  /// What should be on the device: those, or what they will be once all of it is there.
  std::span<const culling::ObjectRun> to_bring() const {
    return awaited ? std::span<const culling::ObjectRun>(coming_objects) : objects();
  }
  /// In no order, disjoint.
  std::span<const culling::LeafRun> blocks() const {
    if (kept) return kept_blocks;
    return with_nodes ? std::span<const culling::LeafRun>(city_blocks) : answer.blocks();
  }
  std::uint64_t block_count() const {
    std::uint64_t n = 0;
    for (const culling::LeafRun& run : blocks()) n += run.last - run.first;
    return n;
  }
  /// Of what a host has put there: Nodes::find.
  std::span<const culling::ObjectRun> nodes() const { return answer.objects().subspan(city_runs); }

  culling::Answer answer;
  std::size_t city_runs = 0;                  ///< of the answer; what follows are nodes
  bool with_nodes = false;                    ///< the answer is about a tree with nodes
  std::vector<culling::LeafRun> city_blocks;  ///< of it those that are the city's
  bool kept = false;                          ///< only a part of the answer is seen: scenegraph/horizon.h
  std::vector<culling::LeafRun> kept_blocks;  ///< that part
  std::vector<culling::ObjectRun> kept_objects;
  bool awaited = false;  ///< something that will hide others is not on the device yet
  std::vector<culling::ObjectRun> coming_objects;
  culling::FrustumD frustum;                          ///< of the last view
  culling::ClassMask classes = culling::kAllClasses;  ///< what is looked for: scenegraph/classes.h
  std::vector<CarState> cars;
};

void find_visible(const Scene& scene, const culling::FrustumD& frustum, Structure structure, VisibleSets& sets);
void find_visible(const Scene& scene, const culling::View& view, Structure structure, VisibleSets& sets);
/// In the city with what a host has put there.
void find_visible(const Nodes& nodes, const culling::FrustumD& frustum, VisibleSets& sets);

/// The cars on half-streets of the visible blocks; in blocks that cross the frustum, each is tested with a ball of
/// kCarRadius against the planes that the block may cross. Call after find_visible. What it costs follows the
/// half-streets of those blocks and the cars on them, whatever there is elsewhere.
CarStats find_cars(const Scene& scene, std::uint64_t tick, VisibleSets& sets);

}  // namespace manzana

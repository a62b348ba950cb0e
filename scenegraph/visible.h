#pragma once
/// camera, time -> what is seen: the middle of the way of the data, once a frame.
///   VisibleSets sets(scene);                                  // reserves once; no allocation afterwards
///   find_visible(scene, view, Structure::bqr, sets);
///   find_cars(scene, tick, Structure::bqr, sets);
#include <cstdint>
#include <vector>

#include "culling/frustum.h"
#include "scenegraph/scene.h"

namespace manzana {

/// How objects are found: through the BqR-Tree, or not at all (everything is submitted), for comparison.
enum class Structure : std::uint8_t { bqr, none };

struct VisibleSets {
  explicit VisibleSets(const Scene& scene);
  culling::Frustum frustum;  ///< relative to the tree's origin
  std::vector<culling::LeafRun> blocks;
  std::vector<culling::ObjectRun> buildings, surfaces, trees;
  std::vector<CarState> cars;
  culling::CullStats stats;
};

void find_visible(const Scene& scene, const culling::View& view, Structure structure, VisibleSets& sets);

/// The cars on half-streets of the visible blocks; in blocks that cross the frustum, each is tested with a ball of
/// kCarRadius. Call after find_visible.
void find_cars(const Scene& scene, std::uint64_t tick, Structure structure, VisibleSets& sets);

}  // namespace manzana

#include "scenegraph/visible.h"

#include <algorithm>

#include "culling/overlap.h"

namespace manzana {

using culling::LeafRun;
using culling::Overlap;

VisibleSets::VisibleSets(const Scene& scene) {
  blocks.reserve(scene.blocks.size());
  buildings.reserve(scene.buildings.table.size());
  surfaces.reserve(scene.surfaces.table.size());
  trees.reserve(scene.trees.table.size());
  cars.reserve(scene.traffic.cars());
}

void find_visible(const Scene& scene, const culling::View& view, Structure structure, VisibleSets& sets) {
  sets.frustum = narrow(make_frustum(view), scene.tree.origin);
  sets.blocks.clear();
  sets.stats = {};
  if (structure == Structure::none) {
    sets.blocks.push_back({0, static_cast<std::uint32_t>(scene.blocks.size()), Overlap::inside});
    take_all(scene.buildings.table, sets.buildings);
    take_all(scene.surfaces.table, sets.surfaces);
    take_all(scene.trees.table, sets.trees);
    return;
  }
  sets.stats = cull(scene.tree, sets.frustum, [&](const LeafRun& run) {
    sets.blocks.push_back(run);
    if (run.where == Overlap::inside) return;
    prefetch(scene.buildings.table, run);
    prefetch(scene.surfaces.table, run);
    prefetch(scene.trees.table, run);
  });
  cull_objects(scene.buildings.table, sets.blocks, sets.frustum, sets.buildings);
  cull_objects(scene.surfaces.table, sets.blocks, sets.frustum, sets.surfaces);
  cull_objects(scene.trees.table, sets.blocks, sets.frustum, sets.trees);
}

void find_cars(const Scene& scene, std::uint64_t tick, Structure structure, VisibleSets& sets) {
  sets.cars.clear();
  const auto unseen = [&](const CarState& car) {
    const auto ball = culling::narrow(culling::SphereD{car.position, kCarRadius}, scene.tree.origin);
    return overlap(sets.frustum, ball) == Overlap::outside;
  };
  for (const LeafRun& run : sets.blocks) {
    const auto first = static_cast<std::ptrdiff_t>(sets.cars.size());
    for (std::uint32_t block = run.first; block < run.last; ++block)
      cars_of_block(scene.traffic, block, tick, sets.cars);
    if (structure == Structure::bqr && run.where == Overlap::crosses)
      sets.cars.erase(std::remove_if(sets.cars.begin() + first, sets.cars.end(), unseen), sets.cars.end());
  }
}

}  // namespace manzana

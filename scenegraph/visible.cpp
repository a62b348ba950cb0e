#include "scenegraph/visible.h"

#include <algorithm>

#include "culling/overlap.h"

namespace manzana {

using culling::LeafRun;

namespace {

void find_in(const culling::BqrTree& tree, const culling::Planes& planes, VisibleSets& sets) {
  cull(tree, planes, sets.answer, {.classes = sets.classes, .blocks = true});
  sets.city_runs = ordered(sets.answer).size();
  sets.kept = sets.awaited = false;
}

}  // namespace

VisibleSets::VisibleSets(const Scene& scene) : answer(scene.tree) { cars.reserve(scene.traffic.cars()); }

void find_visible(const Scene& scene, const culling::FrustumD& frustum, Structure structure, VisibleSets& sets) {
  sets.frustum = frustum;
  // Without planes everything is inside.
  const culling::Planes planes =
      structure == Structure::none ? culling::Planes{} : make_planes(scene.tree, sets.frustum);
  find_in(scene.tree, planes, sets);
  sets.with_nodes = false;
}

void find_visible(const Nodes& nodes, const culling::FrustumD& frustum, VisibleSets& sets) {
  sets.frustum = frustum;
  find_in(nodes.tree(), make_planes(nodes.tree(), frustum), sets);
  const auto of_city = [&](const culling::ObjectRun& run) { return run.first < nodes.first_object(); };
  const auto runs = sets.answer.objects();
  sets.city_runs = static_cast<std::size_t>(std::partition_point(runs.begin(), runs.end(), of_city) - runs.begin());
  sets.with_nodes = true;
  sets.city_blocks.clear();
  for (const LeafRun& run : sets.answer.blocks())
    if (run.first < nodes.city_blocks()) sets.city_blocks.push_back(run);
}

void find_visible(const Scene& scene, const culling::View& view, Structure structure, VisibleSets& sets) {
  find_visible(scene, make_frustum(view), structure, sets);
}

CarStats find_cars(const Scene& scene, std::uint64_t tick, VisibleSets& sets) {
  CarStats stats;
  sets.cars.clear();
  if ((sets.classes & kCar) == 0) return stats;
  for (const LeafRun& run : sets.blocks()) {
    const auto unseen = [&](const CarState& car) {
      return outside(sets.frustum, run.planes, {car.position, kCarRadius});
    };
    const auto first = static_cast<std::ptrdiff_t>(sets.cars.size());
    for (std::uint32_t block = run.first; block < run.last; ++block)
      stats += cars_of_block(scene.traffic, block, tick, sets.cars);
    if (!run.inside())
      sets.cars.erase(std::remove_if(sets.cars.begin() + first, sets.cars.end(), unseen), sets.cars.end());
  }
  return stats;
}

}  // namespace manzana

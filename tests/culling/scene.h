#pragma once
/// A generated city with its tree and its objects as columns, ready to be asked.
#include "culling/baselines/exact.h"
#include "tests/culling/city.h"

namespace manzana::culling::test {

struct Scene {
  City city;
  BqrTree tree;
  std::vector<BoxD> boxes;  ///< of the objects, in the tree's order
  ObjectTable table;
};

inline Scene make_scene(City city) {
  Scene s{std::move(city), {}, {}, {}};
  s.tree = build_bqr_tree(s.city.blocks);
  Ordered objects = ordered_objects(s.city, s.tree);
  s.boxes = std::move(objects.boxes);
  s.table = build_object_table(s.tree.origin, s.boxes, std::move(objects.first));
  return s;
}

/// 10 000 objects in 400 blocks, 2 km wide.
inline Scene city_10k(const Vec3d& center = Vec3d(0)) { return make_scene(make_city(20, 25, 1, center)); }

/// The buffers of a query, with room for any answer.
struct Answer {
  std::vector<LeafRun> blocks;
  std::vector<ObjectRun> objects;
  CullStats stats;
  explicit Answer(const Scene& s) {
    blocks.reserve(s.tree.order.size());
    reserve_runs(objects, s.table);
  }
};

inline void ask_blocks(const Scene& s, const Frustum& frustum, Answer& answer) {
  answer.blocks.clear();
  answer.stats = cull(s.tree, frustum, [&](const LeafRun& run) { answer.blocks.push_back(run); });
}
inline void ask_objects(const Scene& s, const Frustum& frustum, Answer& answer) {
  cull_objects(s.table, answer.blocks, frustum, answer.objects);
}

inline Frustum frustum_of(const Scene& s, const View& view) { return narrow(make_frustum(view), s.tree.origin); }

/// A flag a leaf or an object.
template <class Run>
std::vector<bool> flags(const std::vector<Run>& runs, std::size_t n) {
  std::vector<bool> seen(n);
  for (const Run& run : runs)
    for (std::uint32_t i = run.first; i < run.last; ++i) seen[i] = true;
  return seen;
}

}  // namespace manzana::culling::test

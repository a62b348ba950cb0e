// How long a query takes. Hidden: culling_tests "[.bench]"
#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <iostream>

#include "tests/culling/scene.h"

namespace manzana::culling::test {
namespace {

/// The best of some batches: other programs only ever make it slower.
template <class F>
double quickest_us(F f) {
  double best = std::numeric_limits<double>::infinity();
  for (int batch = 0; batch < 9; ++batch) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < 10; ++i) f();
    const auto end = std::chrono::steady_clock::now();
    best = std::min(best, std::chrono::duration<double, std::micro>(end - start).count() / 10);
  }
  return best;
}

void time_path(const Scene& s, const char* name) {
  Answer answer(s);
  std::vector<double> tree_us, all_us;
  std::uint64_t nodes = 0, leaves = 0, doubtful = 0;
  for (int frame = 0; frame < 300; ++frame) {
    const Frustum frustum = frustum_of(s, pina_view(s.city, frame / 299.0));
    tree_us.push_back(quickest_us([&] { ask_blocks(s, frustum, answer); }));
    all_us.push_back(tree_us.back() + quickest_us([&] { ask_objects(s, frustum, answer); }));
    nodes += answer.stats.nodes_tested;
    leaves += answer.stats.leaves_tested;
    for (const LeafRun& run : answer.blocks)
      if (run.where == Overlap::crosses) doubtful += s.table.first[run.last] - s.table.first[run.first];
  }
  std::sort(tree_us.begin(), tree_us.end());
  std::sort(all_us.begin(), all_us.end());
  std::cout << name << ", " << s.table.size() << " objects in " << s.tree.order.size() << " blocks: tree "
            << tree_us[150] << " us, tree and objects " << all_us[150] << " us (medians), " << all_us.back()
            << " us (worst); tested a frame: " << nodes / 300 << " nodes, " << leaves / 300 << " leaves, "
            << doubtful / 300 << " objects\n";
}

TEST_CASE("time of a query", "[.bench]") {
  time_path(city_10k(), "10k");
  time_path(make_scene(make_city(63, 25, 1)), "100k");
}

}  // namespace
}  // namespace manzana::culling::test

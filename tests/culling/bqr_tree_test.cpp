#include <catch2/catch.hpp>
#include <limits>
#include <set>

#include "tests/culling/city.h"

namespace manzana::culling::test {
namespace {

BlockVolume block_at(double x, double y) {
  const BoxD box{{x - 1, y - 1, 0}, {x + 1, y + 1, 3}};
  return {{x, y}, box, enclosing_sphere(box)};
}

void check_links(const BqrTree& tree) {
  std::set<std::uint64_t> keys;
  for (const BqrNode& node : tree.nodes) keys.insert(node.key);
  CHECK(keys.size() == tree.nodes.size());
  std::uint32_t next_leaf = 0;
  for (const BqrNode& node : tree.nodes)
    if (node.leaf()) CHECK(node.first == next_leaf++);
  CHECK(next_leaf == tree.order.size());
}

TEST_CASE("no block, one block") {
  CHECK(build_bqr_tree({}).nodes.empty());
  const std::vector<BlockVolume> one{block_at(5, 5)};
  const BqrTree tree = build_bqr_tree(one);
  REQUIRE(tree.nodes.size() == 1);
  CHECK(tree.nodes[0].leaf());
  CHECK(tree.nodes[0].key == 1);
}

TEST_CASE("coincident centres become leaves of one node") {
  const std::vector<BlockVolume> blocks{block_at(0, 0), block_at(9, 9), block_at(9, 9), block_at(9, 9)};
  const BqrTree tree = build_bqr_tree(blocks);
  CHECK(tree.nodes.size() == 6);
  check_links(tree);
}

}  // namespace
}  // namespace manzana::culling::test

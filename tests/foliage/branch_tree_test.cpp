#include "foliage/branch_tree.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <numeric>
#include <string>

#include "foliage/random.h"

namespace manzana::foliage {
namespace {

using Parents = std::vector<std::int32_t>;
using Weights = std::vector<std::uint64_t>;
using Paths = std::vector<std::vector<std::uint32_t>>;

struct Named {
  Parents parents;
  std::vector<std::uint32_t> names;
};

/// "C1[C2[C3]][C4]": a module and its children in brackets.
Named parse(const std::string& text) {
  Named tree;
  std::vector<std::int32_t> open{-1};
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == 'C') {
      tree.parents.push_back(open.back());
      tree.names.push_back(static_cast<std::uint32_t>(std::stoul(text.substr(i + 1))));
      open.push_back(static_cast<std::int32_t>(tree.parents.size()) - 1);
    }
    if (text[i] == ']') open.pop_back();
  }
  return tree;
}

Paths unrolled(const TreePaths& paths) {
  Paths out;
  std::uint32_t first = 0;
  for (const std::uint32_t end : paths.ends) {
    out.emplace_back(paths.order.begin() + first, paths.order.begin() + end);
    first = end;
  }
  CHECK(first == paths.order.size());
  return out;
}

/// The definition, word by word: all weights anew for each path.
Paths by_definition(const Parents& parents, const Weights& own) {
  Paths out;
  std::vector<bool> taken(parents.size(), false);
  std::vector<std::vector<std::size_t>> children(parents.size() + 1);
  for (std::size_t i = 0; i < parents.size(); ++i) children[static_cast<std::size_t>(parents[i] + 1)].push_back(i);
  for (std::size_t left = parents.size(); left > 0;) {
    Weights weight(parents.size(), 0), nodes(parents.size(), 0);
    for (std::size_t i = parents.size(); i-- > 0;) {
      if (!taken[i]) weight[i] += own[i], ++nodes[i];
      if (parents[i] < 0) continue;
      weight[static_cast<std::size_t>(parents[i])] += weight[i];
      nodes[static_cast<std::size_t>(parents[i])] += nodes[i];
    }
    std::vector<std::uint32_t> path;
    for (std::size_t at = 0;;) {
      std::size_t best = parents.size();
      for (const std::size_t c : children[at])
        if (nodes[c] > 0 && (best == parents.size() || weight[c] > weight[best])) best = c;
      if (best == parents.size()) break;
      if (!taken[best]) path.push_back(static_cast<std::uint32_t>(best)), taken[best] = true, --left;
      at = best + 1;
    }
    out.push_back(path);
  }
  return out;
}

Parents random_tree(Random& random, std::size_t size, std::uint64_t reach) {
  Parents parents;
  for (std::size_t i = 0; i < size; ++i)
    parents.push_back(static_cast<std::int32_t>(i) - 1 -
                      static_cast<std::int32_t>(random.bits() % std::min(i + 1, reach)));
  return parents;
}

}  // namespace

TEST_CASE("the paths of the golden string are those of the source") {
  const Named tree = parse("C1[C2[C3[C4][C5[C6][C7]]][C9[C11][C10]][C8]][C12[C13][C14][C15[C16]]]");
  REQUIRE(tree.parents.size() == 16);
  Paths levels = unrolled(heaviest_paths(tree.parents, Weights(16, 1)));
  for (auto& level : levels)
    for (auto& node : level) node = tree.names[node];
  CHECK(levels == Paths{{1, 2, 3, 5, 6}, {9, 11}, {12, 15, 16}, {4}, {7}, {10}, {13}, {8}, {14}});
}

TEST_CASE("paths are those of the definition on random trees") {
  Random random(3);
  for (int round = 0; round < 300; ++round) {
    const Parents parents = random_tree(random, 1 + random.bits() % 40, 1 + random.bits() % 40);
    Weights weights;
    const std::uint64_t kinds = 1 + random.bits() % 5;  // few, so that many are equal; some are 0
    for (std::size_t i = 0; i < parents.size(); ++i) weights.push_back(random.bits() % kinds);
    CHECK(unrolled(heaviest_paths(parents, weights)) == by_definition(parents, weights));
  }
}

TEST_CASE("every prefix of the order is a tree and all of it is all nodes") {
  Random random(4);
  const Parents parents = random_tree(random, 5000, 60);
  Weights weights;
  for (std::size_t i = 0; i < parents.size(); ++i) weights.push_back(random.bits() % 1000);
  const TreePaths paths = heaviest_paths(parents, weights);
  std::vector<bool> taken(parents.size(), false);
  bool closed = true;
  for (const std::uint32_t node : paths.order) {
    closed = closed && !taken[node] && (parents[node] < 0 || taken[static_cast<std::size_t>(parents[node])]);
    taken[node] = true;
  }
  CHECK(closed);
  CHECK(std::count(taken.begin(), taken.end(), true) == 5000);
}

TEST_CASE("the largest trees are taken apart without recursion") {
  Parents chain(10'000'000);
  std::iota(chain.begin(), chain.end(), -1);
  const TreePaths deep = heaviest_paths(chain, Weights(chain.size(), 1));
  CHECK(deep.ends.size() == 1);
  CHECK(std::is_sorted(deep.order.begin(), deep.order.end()));
  Parents siblings(1'000'000, 0);
  siblings[0] = -1;
  const TreePaths wide = heaviest_paths(siblings, Weights(siblings.size(), 1));
  CHECK(wide.ends.size() == siblings.size() - 1);
  CHECK(wide.ends.front() == 2);
  CHECK(std::is_sorted(wide.order.begin(), wide.order.end()));  // equals in the order they came in
  CHECK(heaviest_paths({}, {}).order.empty());
}

}  // namespace manzana::foliage

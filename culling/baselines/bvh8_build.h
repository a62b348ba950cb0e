#pragma once
/// The tree of culling/baselines/bvh8.h, and its builder.
#include <array>

#include "culling/baselines/city.h"

namespace manzana::baselines {

/// The boxes of eight neighbours in columns: min x, y, z, then max x, y, z.
struct alignas(64) Boxes8 {
  std::array<std::array<float, 8>, 6> columns{};
  void put(std::size_t lane, const culling::Box& box);
};

/// Child i holds the objects [first[i], first[i + 1]). It is node `below` + i, or, on the lowest level, the packet
/// first[i] / 8. Four cache lines.
struct alignas(64) Node8 {
  Boxes8 bounds;
  std::array<std::uint32_t, 9> first{};
  std::uint32_t below = 0;
  std::uint32_t children = 0;  ///< a bit each
  bool lowest = true;
};

struct Tree8 {
  std::vector<Node8> nodes;          ///< nodes[0] is the root; the children of a node are neighbours
  std::vector<Boxes8> packets;       ///< of objects, by eights of positions
  std::vector<std::uint32_t> order;  ///< position -> row of City::boxes
};

/// O(n log n). `boxes`: a row an object, not empty.
Tree8 build_tree8(std::span<const culling::Box> boxes);

}  // namespace manzana::baselines

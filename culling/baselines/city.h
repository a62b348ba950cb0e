#pragma once
/// A city as every structure of the benchmark gets it: blocks, and their objects in block order.
///   City city = make_city(find_case("100k"), seed);            // culling/baselines/cases.h
///   std::unique_ptr<Peer> peer = make_peer("bvh8", city);      // culling/baselines/peer.h
#include <cstdint>
#include <span>
#include <vector>

#include "culling/bqr_tree.h"

namespace manzana::baselines {

enum class ObjectKind : std::uint8_t { building, tree, car, ground };

struct City {
  std::vector<culling::BlockVolume> blocks;  ///< each encloses all of its objects
  std::vector<std::uint32_t> first{0};       ///< blocks + 1: objects of block b are [first[b], first[b + 1])
  std::vector<culling::BoxD> boxes;          ///< a row an object, in L, metres
  std::vector<ObjectKind> kinds;             ///< a row an object
  std::vector<std::uint32_t> triangles;      ///< a row an object
  culling::BoxD bounds;                      ///< of all blocks
  culling::BoxD flown;                       ///< what the flight crosses, C2 in C3 to C6; empty: all of it
  std::uint32_t objects() const { return static_cast<std::uint32_t>(boxes.size()); }
};

}  // namespace manzana::baselines

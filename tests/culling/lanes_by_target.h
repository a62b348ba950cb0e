#pragma once
/// What culling/lanes-inl.h answers, by the vectors that on_each_target (tests/culling/scene.h) has chosen.
#include "culling/planes.h"

namespace manzana::culling::test {

struct NodeAnswer {
  std::array<std::uint16_t, kMaxPlanes> t_out{}, t_in{};
  std::array<Lanes16, kMaxPlanes> need{};
  Lanes16 planes{};
  std::uint32_t alive = 0, inside = 0;
};
NodeAnswer ask_node(const Planes& planes, unsigned which, const BqrNode& node);

/// 32 boxes in columns. `need` of one lane.
std::uint32_t ask_packet(const Planes& planes, unsigned which, const Packet& packet, const std::uint16_t* need);

}  // namespace manzana::culling::test

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/culling/lanes_by_target.cpp"
#include <hwy/foreach_target.h>
// after foreach_target.h
#include <hwy/highway.h>

#include <algorithm>

#include "culling/lanes-inl.h"
#include "tests/culling/lanes_by_target.h"

HWY_BEFORE_NAMESPACE();
namespace manzana::culling::HWY_NAMESPACE {

void node_answer(const Planes& planes, unsigned which, const BqrNode& node, test::NodeAnswer& answer) {
  const Thresholds t = thresholds_of(planes, node);
  answer.t_out = t.out;
  answer.t_in = t.in;
  NodeResult result;
  test_node(planes, which, node, result);
  answer.need = result.need;
  answer.planes = result.planes;
  answer.alive = result.alive;
  answer.inside = result.inside;
}

std::uint32_t packet_answer(const Planes& planes, unsigned which, const Packet& packet, const std::uint16_t* need) {
  return kept(planes, which, packet, need);
}

}  // namespace manzana::culling::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace manzana::culling {
HWY_EXPORT(node_answer);
HWY_EXPORT(packet_answer);

test::NodeAnswer test::ask_node(const Planes& planes, unsigned which, const BqrNode& node) {
  NodeAnswer answer;
  HWY_DYNAMIC_DISPATCH(node_answer)(planes, which, node, answer);
  return answer;
}
std::uint32_t test::ask_packet(const Planes& planes, unsigned which, const Packet& packet, const std::uint16_t* need) {
  return HWY_DYNAMIC_DISPATCH(packet_answer)(planes, which, packet, need);
}
}  // namespace manzana::culling
#endif

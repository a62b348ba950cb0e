#pragma once
/// The query on all threads, for views that cross very much: a plane along the roofs of a whole city, or one class
/// among others when all is in view.
///   Crew crew;                                                  // once
///   cull_parallel(tree, make_planes(tree, frustum), crew, answer);
/// Begins as cull() does, and goes on so unless more nodes wait than `kSharedAbove`: what most views visit is done
/// before another thread has woken up (docs/measurements.md). The same runs as cull() finds, in another order.
#include <vector>

#include "culling/cull.h"

namespace manzana::culling {

/// From where on two threads are faster than one, measured.
inline constexpr std::uint32_t kSharedAbove = 320;

/// What each thread finds, kept from frame to frame: nothing is allocated once a query about as many views was shared.
struct Crew {
  struct Member {
    std::vector<Answer> answers;  ///< by view
    CullStats stats;
  };
  std::uint32_t shared_above = kSharedAbove;
  std::vector<Member> members;  ///< by thread
};

CullStats cull_parallel(const BqrTree& tree, const Planes& planes, Crew& crew, Answer& answer,
                        const CullOptions& options = {});
CullStats cull_parallel(const BqrTree& tree, std::span<const Planes> views, Crew& crew, std::span<Answer> answers,
                        const CullOptions& options = {});

}  // namespace manzana::culling

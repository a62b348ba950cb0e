#pragma once
/// A query in pieces, for those who share it among threads.
///   Waiting waiting;
///   const Query query = start(tree, views, answers, options, waiting);
///   stats += visit(query, answers, waiting, 100);               // until nothing waits, or over a hundred nodes do
#include "culling/answer_access.h"

namespace manzana::culling {

struct Query {
  const BqrTree& tree;
  std::span<const Planes> views;
  CullOptions options;
};

/// Nodes that are still to be visited: [head, end) of a queue with room for all nodes of the tree.
struct Waiting {
  Answer::Visit* queue = nullptr;
  std::uint32_t head = 0, end = 0;
  std::uint32_t count() const { return end - head; }
};
inline constexpr std::uint32_t kAnyNumber = ~std::uint32_t{0};

/// Clears the answers and makes room in them; the first one's queue is the one to wait in. Nothing waits yet: the first
/// visit is the root's.
Query start(const BqrTree& tree, std::span<const Planes> views, std::span<Answer> answers, const CullOptions& options,
            Waiting& waiting);

/// Visits what waits, until that is nothing or more than `most`, and adds to the answers. The tree has nodes. What
/// nodes that wait lead to is disjoint: some of it may be looked for with another queue and other answers.
CullStats visit(const Query& query, std::span<Answer> answers, Waiting& waiting, std::uint32_t most);

}  // namespace manzana::culling

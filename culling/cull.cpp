// Nodes are visited level by level, in batches: first all of a batch are tested, then their lanes are handed on; so no
// test waits for a mispredicted branch, and what comes next is already on its way from memory.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "culling/cull.cpp"
#include <hwy/foreach_target.h>
// after foreach_target.h
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cassert>

#include <hwy/cache_control.h>

#include "culling/cull.h"
#include "culling/lanes-inl.h"
#include "culling/query.h"

HWY_BEFORE_NAMESPACE();
namespace manzana::culling::HWY_NAMESPACE {

/// Objects of a block that crosses, in one packet from `row` on; or all of them, if they are many.
struct Doubt {
  const Packet* packet;
  const std::uint16_t* need;
  std::uint32_t first, count, keep;
  std::uint8_t planes, row, view;
};

inline std::uint32_t low_bits(std::uint32_t n) { return static_cast<std::uint32_t>((std::uint64_t{1} << n) - 1); }

/// One query about kViews views.
template <std::size_t kViews>
class Traversal {
 public:
  Traversal(const BqrTree& tree, std::span<const Planes> views, std::span<Answer> answers, const CullOptions& options)
      : tree_(tree),
        packets_(tree.packets.data()),
        views_(views),
        queue_(Answer::Access::queue(answers[0])),
        options_(options),
        filtered_(options.classes != kAllClasses) {
    for (std::size_t v = 0; v < answers.size(); ++v) {
      objects_[v] = Answer::Access::objects(answers[v]).begin();
      blocks_[v] = Answer::Access::blocks(answers[v]).begin();
    }
  }

  CullStats run() {
    push_root();
    for (std::uint32_t head = 0; head < end_;) head += visit_batch(head);
    stats_.nodes = end_;
    return stats_;
  }

  /// Goes on with what waits, and adds to the answers.
  CullStats run(std::span<Answer> answers, Waiting& waiting, std::uint32_t most) {
    for (std::size_t v = 0; v < answers.size(); ++v) {
      objects_[v] = Answer::Access::objects(answers[v]).end();
      blocks_[v] = Answer::Access::blocks(answers[v]).end();
    }
    queue_ = waiting.queue;
    end_ = waiting.end;
    std::uint32_t head = waiting.head;
    if (end_ == 0) push_root();
    while (head < end_ && end_ - head <= most) head += visit_batch(head);
    stats_.nodes = head - waiting.head;
    waiting = {queue_, head, end_};
    return stats_;
  }

  void finish(std::span<Answer> answers) const {
    for (std::size_t v = 0; v < answers.size(); ++v) {
      Answer::Access::objects(answers[v]).end_at(objects_[v]);
      Answer::Access::blocks(answers[v]).end_at(blocks_[v]);
    }
  }

 private:
  static constexpr std::uint32_t kBatch = kViews == 1 ? 16 : 4;
  static constexpr bool kOne = kViews == 1;
  static constexpr std::size_t kRead = offsetof(BqrNode, sphere);  // of a node, as a rule

  template <class F>
  HWY_INLINE void each_view(std::uint32_t views, F f) const {
    if constexpr (kOne)
      f(std::size_t{0});
    else
      for (; views != 0; views &= views - 1) f(static_cast<std::size_t>(std::countr_zero(views)));
  }
  static unsigned planes_of(const Answer::Visit& visit, std::size_t view) {
    return static_cast<unsigned>(visit.planes >> (8 * view)) & 0xFFU;
  }

  HWY_INLINE std::uint32_t visit_batch(std::uint32_t head) {
    const std::uint32_t n = std::min(kBatch, end_ - head);
    for (std::uint32_t i = 0; i < n; ++i) test(queue_[head + i], i);
    for (std::uint32_t i = 0; i < n; ++i) hand_on(queue_[head + i], i);
    settle();
    return n;
  }

  void push_root() {
    Answer::Visit& root = queue_[end_++];
    root = {tree_.root, 0, 0};
    for (std::size_t v = 0; v < (kOne ? 1 : views_.size()); ++v) {
      root.views |= 1U << v;
      root.planes |= std::uint64_t{views_[v].used} << (8 * v);
    }
  }

  HWY_INLINE void test(const Answer::Visit& visit, std::uint32_t i) {
    const BqrNode& n = tree_.nodes[visit.node];
    each_view(visit.views, [&](std::size_t v) {
      NodeResult& result = results_[i * kViews + v];
      test_node(views_[v], planes_of(visit, v), n, result);
      if (filtered_) filter(n, result);
    });
  }

  /// Lanes with nothing wanted are gone; lanes with something else too cannot be taken whole.
  void filter(const BqrNode& n, NodeResult& result) const {
    result.alive &= lanes_of(n.classes.data(), options_.classes);
    result.inside &= result.alive & ~lanes_of(n.classes.data(), static_cast<ClassMask>(~options_.classes));
  }

  HWY_INLINE void hand_on(const Answer::Visit& visit, std::uint32_t i) {
    const BqrNode& n = tree_.nodes[visit.node];
    std::uint32_t nodes = 0;
    each_view(visit.views, [&](std::size_t v) {
      const NodeResult& result = results_[i * kViews + v];
      const std::uint32_t taken = result.inside & n.whole, rest = result.alive & ~taken;
      take(n, taken, v);
      doubt(n, result, rest & n.blocks, v);
      nodes |= rest & ~n.blocks;
    });
    for (; nodes != 0; nodes &= nodes - 1) push(n, visit, i, static_cast<std::uint32_t>(std::countr_zero(nodes)));
  }

  HWY_INLINE void push(const BqrNode& n, const Answer::Visit& from, std::uint32_t i, std::uint32_t lane) {
    Answer::Visit& to = queue_[end_++];
    to = {n.child[lane], 0, 0};
    each_view(from.views, [&](std::size_t v) {
      const NodeResult& result = results_[i * kViews + v];
      const std::uint32_t open = (result.alive & ~(result.inside & n.whole)) >> lane & 1;
      to.views |= open << v;
      to.planes |= std::uint64_t{result.planes[lane]} << (8 * v);
    });
    prefetch(&tree_.nodes[n.child[lane]], kRead);
  }

  /// Neighbouring lanes that are inside are one run.
  HWY_INLINE void take(const BqrNode& n, std::uint32_t lanes, std::size_t v) {
    if (lanes == 0) return;
    const std::uint32_t full = lanes & holding(n);  // a run without objects would need room of its own
    objects_[v] = write_runs(n, starts_of(n, full), ends_of(n, full), objects_[v]);
    if (options_.blocks) take_blocks(n, lanes, v);
  }
  static std::uint32_t starts_of(const BqrNode& n, std::uint32_t lanes) {
    return n.ordered ? lanes & ~(lanes << 1) : lanes;
  }
  static std::uint32_t ends_of(const BqrNode& n, std::uint32_t lanes) {
    return n.ordered ? lanes & ~(lanes >> 1) : lanes;
  }

  HWY_NOINLINE void take_blocks(const BqrNode& n, std::uint32_t lanes, std::size_t v) {
    for (std::uint32_t starts = starts_of(n, lanes), ends = ends_of(n, lanes); starts != 0;
         starts &= starts - 1, ends &= ends - 1)
      *blocks_[v]++ = {n.first_block[static_cast<std::size_t>(std::countr_zero(starts))],
                       n.last_block[static_cast<std::size_t>(std::countr_zero(ends))], 0};
  }

  /// Blocks that cross.
  HWY_INLINE void doubt(const BqrNode& n, const NodeResult& result, std::uint32_t lanes, std::size_t v) {
    Doubt* to = &doubts_[doubted_];
    for (std::uint32_t left = lanes; left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      const std::uint32_t planes = result.planes[i];
      const Packet* packet = packets_ + n.child[i] / kPacket;
      std::uint32_t first = n.first[i], count = n.last[i] - first;
      if (count == 0) [[unlikely]]
        continue;
      for (;;) {
        *to++ = {packet,
                 &result.need[0][i],
                 first,
                 count,
                 0,
                 static_cast<std::uint8_t>(planes),
                 static_cast<std::uint8_t>(n.child[i] % kPacket),
                 static_cast<std::uint8_t>(v)};
        fetch(*packet, planes, v);
        if (count <= kPacket || count > kFew * kPacket) [[likely]]
          break;
        to[-1].count = kPacket;
        first += kPacket;
        count -= kPacket;
        ++packet;
      }
    }
    doubted_ = static_cast<std::uint32_t>(to - doubts_.data());
    stats_.blocks += static_cast<std::uint32_t>(std::popcount(lanes));
    if (options_.blocks) doubt_blocks(n, result, lanes, v);
  }

  HWY_NOINLINE void doubt_blocks(const BqrNode& n, const NodeResult& result, std::uint32_t lanes, std::size_t v) {
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(lanes));
      *blocks_[v]++ = {n.first_block[i], n.first_block[i] + 1, result.planes[i]};
    }
  }

  HWY_INLINE void settle() {
    for (std::uint32_t i = 0; i < doubted_; ++i) {
      Doubt& b = doubts_[i];
      if (b.count > kPacket) continue;
      b.keep = ask(b, *b.packet) >> b.row & low_bits(b.count);
      if (filtered_) b.keep &= wanted(b.first);
    }
    for (std::uint32_t i = 0; i < doubted_; ++i)
      if (doubts_[i].count <= kPacket)
        take_bits(doubts_[i].first, doubts_[i].keep, kOne ? 0 : doubts_[i].view);
      else
        settle_large(doubts_[i]);
    stats_.packets += doubted_;
    doubted_ = 0;
  }

  /// Many packets: first those that enclose packets.
  HWY_NOINLINE void settle_large(const Doubt& b) {
    const std::uint32_t n = (b.count + kPacket - 1) / kPacket, enclosing = (n + kPacket - 1) / kPacket;
    for (std::uint32_t e = 0; e < enclosing; ++e) {
      std::uint32_t open = ask(b, b.packet[e]) & low_bits(std::min(kPacket, n - e * kPacket));
      for (std::uint32_t p = open; p != 0; p &= p - 1)
        fetch(b.packet[enclosing + e * kPacket + static_cast<std::uint32_t>(std::countr_zero(p))], b.planes, b.view);
      for (; open != 0; open &= open - 1) {
        const std::uint32_t p = e * kPacket + static_cast<std::uint32_t>(std::countr_zero(open));
        const std::uint32_t first = b.first + p * kPacket;
        std::uint32_t keep = ask(b, b.packet[enclosing + p]) & low_bits(std::min(kPacket, b.count - p * kPacket));
        if (filtered_) keep &= wanted(first);
        take_bits(first, keep, kOne ? 0 : b.view);
        ++stats_.packets;
      }
    }
  }

  HWY_INLINE std::uint32_t ask(const Doubt& b, const Packet& packet) const {
    return kept(views_[kOne ? 0 : b.view], b.planes, packet, b.need);
  }

  std::uint32_t wanted(std::uint32_t first) const {
    const ClassMask* row = &tree_.classes[first];
    return lanes_of(row, options_.classes) | lanes_of(row + kLanes, options_.classes) << kLanes;
  }

  HWY_INLINE void take_bits(std::uint32_t first, std::uint32_t keep, std::uint32_t v) {
    objects_[v] = write_runs(first, keep, objects_[v]);
  }

  /// What the first of the planes asks; as a rule there is but one.
  HWY_INLINE void fetch(const Packet& packet, unsigned planes, std::size_t v) const {
    if (planes == 0) return;
    for (const std::uint8_t at : views_[v].slopes[static_cast<std::size_t>(std::countr_zero(planes))].inner)
      hwy::Prefetch(column_of(packet, at));
  }

  static HWY_INLINE void prefetch(const void* at, std::size_t bytes) {
    for (std::size_t i = 0; i < bytes; i += 64) hwy::Prefetch(static_cast<const char*>(at) + i);
  }

  const BqrTree& tree_;
  const Packet* const packets_;
  const std::span<const Planes> views_;
  Answer::Visit* queue_;
  const CullOptions options_;
  const bool filtered_;
  std::array<ObjectRun*, kViews> objects_{};
  std::array<LeafRun*, kViews> blocks_{};
  std::uint32_t end_ = 0, doubted_ = 0;
  CullStats stats_;
  std::array<NodeResult, kBatch * kViews> results_;
  std::array<Doubt, kBatch * kViews * kLanes * kFew> doubts_;
};

template <std::size_t kViews>
CullStats traverse(const BqrTree& tree, std::span<const Planes> views, std::span<Answer> answers,
                   const CullOptions& options) {
  Traversal<kViews> traversal(tree, views, answers, options);
  const CullStats stats = traversal.run();
  traversal.finish(answers);
  return stats;
}

CullStats cull_one(const BqrTree& tree, std::span<const Planes> views, std::span<Answer> answers,
                   const CullOptions& options) {
  return traverse<1>(tree, views, answers, options);
}
CullStats cull_many(const BqrTree& tree, std::span<const Planes> views, std::span<Answer> answers,
                    const CullOptions& options) {
  return traverse<kMaxViews>(tree, views, answers, options);
}

template <std::size_t kViews>
CullStats go_on(const Query& query, std::span<Answer> answers, Waiting& waiting, std::uint32_t most) {
  Traversal<kViews> traversal(query.tree, query.views, answers, query.options);
  const CullStats stats = traversal.run(answers, waiting, most);
  traversal.finish(answers);
  return stats;
}
CullStats visit_some(const Query& query, std::span<Answer> answers, Waiting& waiting, std::uint32_t most) {
  return query.views.size() == 1 ? go_on<1>(query, answers, waiting, most)
                                 : go_on<kMaxViews>(query, answers, waiting, most);
}

}  // namespace manzana::culling::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace manzana::culling {

HWY_EXPORT(cull_one);
HWY_EXPORT(cull_many);
HWY_EXPORT(visit_some);

namespace {

/// The options, without what does not matter.
CullOptions prepare(const BqrTree& tree, std::span<Answer> answers, CullOptions options) {
  for (Answer& answer : answers) {
    answer.reserve(tree);
    Answer::Access::clear(answer);
  }
  if (tree.classes.empty() && options.classes != 0) options.classes = kAllClasses;
  return options;
}

}  // namespace

CullStats cull(const BqrTree& tree, const Planes& planes, Answer& answer, const CullOptions& options) {
  return cull(tree, std::span(&planes, 1), std::span(&answer, 1), options);
}

CullStats cull(const BqrTree& tree, std::span<const Planes> views, std::span<Answer> answers,
               const CullOptions& options) {
  assert(!views.empty() && views.size() <= kMaxViews && views.size() == answers.size());
  const CullOptions asked = prepare(tree, answers, options);
  if (tree.nodes.empty()) return {};
  return views.size() == 1 ? HWY_DYNAMIC_DISPATCH(cull_one)(tree, views, answers, asked)
                           : HWY_DYNAMIC_DISPATCH(cull_many)(tree, views, answers, asked);
}

Query start(const BqrTree& tree, std::span<const Planes> views, std::span<Answer> answers, const CullOptions& options,
            Waiting& waiting) {
  assert(!views.empty() && views.size() <= kMaxViews && views.size() == answers.size());
  const Query query{tree, views, prepare(tree, answers, options)};
  waiting = {Answer::Access::queue(answers[0]), 0, 0};
  return query;
}

CullStats visit(const Query& query, std::span<Answer> answers, Waiting& waiting, std::uint32_t most) {
  return HWY_DYNAMIC_DISPATCH(visit_some)(query, answers, waiting, most);
}

const char* simd_target() {
  const std::int64_t best = hwy::SupportedTargets() & HWY_TARGETS;
  return hwy::TargetName(best & -best);  // better targets have lower bits
}

}  // namespace manzana::culling
#endif

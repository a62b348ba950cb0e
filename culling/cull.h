#pragma once
/// The query: which objects may be seen. Sixteen children or 32 objects are tested at once, by the widest vectors that
/// the processor at hand has.
///   Answer answer(tree);                                       // once: room for any answer
///   cull(tree, make_planes(tree, frustum), answer);            // each frame
///   for (const ObjectRun& run : answer.objects()) draw(run);
/// Nothing that is seen is ever missing; a run may hold an object that is just outside. [numerics 2]
/// Cost follows what crosses the frustum's sides: a part of the tree that is inside is one run, untested.
#include <memory>

#include "culling/planes.h"

namespace manzana::culling {

/// Half-open run of blocks; either all of it is inside, or it is one block that may cross. Bit k of `planes`: it may
/// reach beyond plane k.
struct LeafRun {
  std::uint32_t first = 0, last = 0;
  std::uint32_t planes = 0;
  bool inside() const { return planes == 0; }
};

/// A list that never grows past its room, and whose room is not touched before it is used.
template <class T>
class List {
 public:
  std::span<const T> items() const { return {data_.get(), size_}; }
  T* begin() { return data_.get(); }
  T* end() { return data_.get() + size_; }
  void end_at(const T* end) { size_ = static_cast<std::size_t>(end - data_.get()); }
  void reserve(std::size_t n) {
    if (n <= room_) return;
    data_ = std::make_unique_for_overwrite<T[]>(n);
    room_ = n;
    size_ = 0;
  }

 private:
  std::unique_ptr<T[]> data_;
  std::size_t room_ = 0, size_ = 0;
};

/// What a query found, and its working memory; kept from frame to frame. Runs are disjoint, in no order.
class Answer {
 public:
  Answer() = default;
  explicit Answer(const BqrTree& tree) { reserve(tree); }
  std::span<const ObjectRun> objects() const { return objects_.items(); }
  /// Only of a query that asked for blocks.
  std::span<const LeafRun> blocks() const { return blocks_.items(); }
  /// Room for any answer about the tree. A query does it itself, but then it may allocate, after the tree has grown.
  void reserve(const BqrTree& tree);

  /// A node to be visited: for each view (8 bits) the planes that it may cross, and the views to which it matters.
  struct Visit {
    std::uint32_t node = 0, views = 0;
    std::uint64_t planes = 0;
  };
  struct Access;  ///< for the query itself

 private:
  List<ObjectRun> objects_, sorted_;
  List<LeafRun> blocks_;
  List<Visit> queue_;
};

struct CullOptions {
  ClassMask classes = kAllClasses;  ///< only objects that are of one of these
  bool blocks = false;              ///< list the blocks too
};

struct CullStats {
  std::uint32_t nodes = 0;    ///< tested, 16 lanes each
  std::uint32_t blocks = 0;   ///< that crossed, so that their objects were tested
  std::uint32_t packets = 0;  ///< of 32 objects, tested
};

CullStats cull(const BqrTree& tree, const Planes& planes, Answer& answer, const CullOptions& options = {});

inline constexpr std::size_t kMaxViews = 8;

/// Several views in one traversal (a camera and its shadows): answers[v] is what view v alone would find; at most
/// kMaxViews. Nodes are read once for all.
CullStats cull(const BqrTree& tree, std::span<const Planes> views, std::span<Answer> answers,
               const CullOptions& options = {});

/// The kind of vectors that queries use on this processor: "AVX3", "AVX2", "SSE4", "NEON", ...
const char* simd_target();

/// In the tree's order, neighbours joined. For those that draw in order. O(n): a radix sort, whose branches need not be
/// guessed; no allocation.
std::span<const ObjectRun> ordered(Answer& answer);

std::uint64_t count(std::span<const ObjectRun> runs);

}  // namespace manzana::culling

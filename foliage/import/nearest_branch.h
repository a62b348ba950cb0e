#pragma once
/// Which branch is nearest to a place: centre lines in a tree of boxes.
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "foliage/plant.h"

namespace manzana::foliage {

/// A piece of a centre line.
struct LinePiece {
  CentrePoint a, b;
  std::uint32_t branch = 0;
  bool foot = false;  ///< a is the branch's foot
};

class LineTree {
 public:
  /// The lines of all branches, from foot to tip.
  LineTree(std::span<const Branch> branches, std::span<const CentrePoint> points);

  struct Found {
    std::uint32_t branch = 0;
    float distance = HUGE_VALF;  ///< to its surface; a tenth of the way to the axis is added, to tell insides apart
  };

  /// Among the branches that keep(branch) admits. `foot_counts`: a place at another branch's foot is rather beside it
  /// than on it, by that branch's radius.
  template <class Keep>
  Found nearest(const Vec3& place, bool foot_counts, Keep&& keep) const {
    Found best;
    std::vector<std::uint32_t> todo;
    if (!nodes_.empty()) todo.push_back(0);
    while (!todo.empty()) {
      const Node& node = nodes_[todo.back()];
      todo.pop_back();
      if (!(least(node, place) < best.distance)) continue;
      for (std::uint32_t i = node.first; i < node.last && node.left == 0; ++i)
        if (keep(pieces_[i].branch)) take(pieces_[i], place, foot_counts, best);
      if (node.left == 0) continue;
      const bool right_first = least(nodes_[node.left + 1], place) < least(nodes_[node.left], place);
      todo.push_back(node.left + (right_first ? 0 : 1));
      todo.push_back(node.left + (right_first ? 1 : 0));
    }
    return best;
  }

 private:
  struct Node {
    Vec3 low{HUGE_VALF}, high{-HUGE_VALF};
    float radius = 0;  // the largest within
    std::uint32_t first = 0, last = 0, left = 0;
  };

  static float least(const Node& node, const Vec3& place);
  static void take(const LinePiece& piece, const Vec3& place, bool foot_counts, Found& best);
  void grow(const LinePiece& piece, Node& node) const;
  void build();

  std::vector<LinePiece> pieces_;
  std::vector<Node> nodes_;
};

}  // namespace manzana::foliage

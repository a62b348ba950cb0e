#include "foliage/branch_tree.h"

#include <algorithm>
#include <numeric>

namespace manzana::foliage {
namespace {

struct Lighter {
  const std::vector<std::uint64_t>& weights;
  bool operator()(std::uint32_t a, std::uint32_t b) const {
    return weights[a] < weights[b] || (weights[a] == weights[b] && a > b);  // of equals the first counts as heavier
  }
};

/// Node 0 is a root above all roots; row i is node i + 1. The children of a node are a heap in one run of `children_`:
/// only the child at its head loses weight, so no entry is ever stale.
class Pruning {
 public:
  Pruning(std::span<const std::int32_t> parents, std::span<const std::uint64_t> weights)
      : own_(weights),
        left_(parents.size() + 1, 0),
        first_(parents.size() + 2, 0),
        end_(left_.size()),
        taken_(parents.size(), false) {
    std::copy(weights.begin(), weights.end(), left_.begin() + 1);
    for (std::size_t node = parents.size(); node > 0; --node) {
      left_[parent_of(parents, node)] += left_[node];
      ++first_[parent_of(parents, node) + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::copy(first_.begin(), first_.end() - 1, end_.begin());
    children_.resize(parents.size());
    for (std::size_t node = 1; node < left_.size(); ++node)
      children_[end_[parent_of(parents, node)]++] = static_cast<std::uint32_t>(node);
    for (std::size_t node = 0; node < left_.size(); ++node)
      std::make_heap(children_.begin() + first_[node], children_.begin() + end_[node], Lighter{left_});
  }

  TreePaths run() {
    TreePaths paths;
    paths.order.reserve(own_.size());
    while (first_[0] < end_[0]) {
      take_path(paths.order);
      paths.ends.push_back(static_cast<std::uint32_t>(paths.order.size()));
    }
    return paths;
  }

 private:
  static std::size_t parent_of(std::span<const std::int32_t> parents, std::size_t node) {
    return static_cast<std::size_t>(parents[node - 1] + 1);
  }

  void take_path(std::vector<std::uint32_t>& order) {
    way_.assign(1, 0);
    while (first_[way_.back()] < end_[way_.back()]) way_.push_back(children_[first_[way_.back()]]);
    for (const std::uint32_t node : way_)
      if (node > 0 && !taken_[node - 1]) order.push_back(node - 1);
    std::uint64_t lost = 0;
    for (std::size_t i = way_.size() - 1; i > 0; --i) {
      const std::uint32_t node = way_[i];
      if (!taken_[node - 1]) lost += own_[node - 1], taken_[node - 1] = true;
      lighten(way_[i - 1], lost);
    }
  }

  /// The child at the head of its parent's heap loses weight, or has nothing left to take.
  void lighten(std::uint32_t parent, std::uint64_t lost) {
    const auto head = children_.begin() + first_[parent], end = children_.begin() + end_[parent];
    const std::uint32_t child = *head;
    std::pop_heap(head, end, Lighter{left_});
    left_[child] -= lost;
    if (first_[child] == end_[child])
      --end_[parent];
    else
      std::push_heap(head, end, Lighter{left_});
  }

  std::span<const std::uint64_t> own_;
  std::vector<std::uint64_t> left_;  // weight of what is not yet taken
  std::vector<std::uint32_t> first_, end_, children_, way_;
  std::vector<bool> taken_;
};

}  // namespace

TreePaths heaviest_paths(std::span<const std::int32_t> parents, std::span<const std::uint64_t> weights) {
  return Pruning(parents, weights).run();
}

}  // namespace manzana::foliage

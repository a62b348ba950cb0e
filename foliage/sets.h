#pragma once
/// Sets of numbers that are joined and never parted; the least member stands for its set. [Tarjan, J. ACM 22(2), 1975]
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace manzana::foliage {

class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::uint32_t find(std::uint32_t v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a), b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace manzana::foliage

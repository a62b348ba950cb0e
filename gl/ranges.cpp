#include "gl/ranges.h"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace manzana::gl {

void Ranges::grow(std::uint32_t size) {
  assert(size >= size_);
  const std::uint32_t more = size - size_, first = size_;
  size_ = size;
  if (more == 0) return;
  taken_ += more;
  give(first, more);
}

std::optional<std::uint32_t> Ranges::take(std::uint32_t n) {
  const auto at = std::ranges::find_if(free_, [&](const auto& room) { return room.second >= n; });
  if (at == free_.end()) return {};
  const auto [first, room] = *at;
  free_.erase(at);
  if (room > n) free_.emplace(first + n, room - n);
  taken_ += n;
  return first;
}

void Ranges::give(std::uint32_t first, std::uint32_t n) {
  assert(n <= taken_);
  taken_ -= n;
  auto after = free_.lower_bound(first);
  if (after != free_.end() && after->first == first + n) {
    n += after->second;
    after = free_.erase(after);
  }
  if (after != free_.begin()) {
    const auto before = std::prev(after);
    if (before->first + before->second == first) {
      before->second += n;
      return;
    }
  }
  free_.emplace(first, n);
}

}  // namespace manzana::gl

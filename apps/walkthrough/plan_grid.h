#pragma once
/// Rectangles of the plan in square cells, for "what is near this point?".
///   PlanGrid grid(32);
///   grid.add({min_x, min_y}, {max_x, max_y}, id); ... grid.finish();
///   grid.visit(point, radius, [&](std::uint32_t id) { ... });     // may name an id twice, and some too far away
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "culling/vec.h"

namespace manzana::walkthrough {

class PlanGrid {
 public:
  explicit PlanGrid(double cell_m) : cell_(cell_m) {}

  /// A rectangle larger than kMostCells a side is clipped to them: nothing in a city is.
  void add(const Vec2d& min, const Vec2d& max, std::uint32_t id) {
    const std::int64_t x1 = std::min(index(max.x), index(min.x) + kMostCells);
    const std::int64_t y1 = std::min(index(max.y), index(min.y) + kMostCells);
    for (std::int64_t y = index(min.y); y <= y1; ++y)
      for (std::int64_t x = index(min.x); x <= x1; ++x) entries_.push_back({key(x, y), id});
  }
  void finish() { std::sort(entries_.begin(), entries_.end()); }

  template <class Visit>
  void visit(const Vec2d& p, double radius, Visit&& visit_id) const {
    for (std::int64_t y = index(p.y - radius); y <= index(p.y + radius); ++y)
      for (std::int64_t x = index(p.x - radius); x <= index(p.x + radius); ++x) visit_cell(key(x, y), visit_id);
  }

 private:
  struct Entry {
    std::uint64_t key = 0;
    std::uint32_t id = 0;
    auto operator<=>(const Entry&) const = default;
  };
  static constexpr std::int64_t kMostCells = 256;

  std::int64_t index(double v) const { return static_cast<std::int64_t>(std::floor(v / cell_)); }
  static std::uint64_t key(std::int64_t x, std::int64_t y) {
    return static_cast<std::uint64_t>(x) << 32 ^ (static_cast<std::uint64_t>(y) & 0xffffffffU);
  }
  template <class Visit>
  void visit_cell(std::uint64_t cell, Visit&& visit_id) const {
    for (auto e = std::lower_bound(entries_.begin(), entries_.end(), Entry{cell, 0});
         e != entries_.end() && e->key == cell; ++e)
      visit_id(e->id);
  }

  double cell_;
  std::vector<Entry> entries_;
};

}  // namespace manzana::walkthrough

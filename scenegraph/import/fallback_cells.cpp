#include "scenegraph/import/fallback_cells.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace manzana {
namespace {

using Rows = std::span<std::uint32_t>;

class Splitter {
 public:
  Splitter(std::span<const Vec2d> points, const CellOptions& options) : points_(points), options_(options) {}

  FallbackCells run() {
    std::vector<std::uint32_t> rows(points_.size());
    std::iota(rows.begin(), rows.end(), 0U);
    result_.of.resize(points_.size());
    if (!rows.empty()) todo_.push_back(rows);
    while (!todo_.empty()) {
      const Rows set = todo_.back();
      todo_.pop_back();
      visit(set);
    }
    return std::move(result_);
  }

 private:
  void visit(Rows set) {
    PlanBox box;
    for (std::uint32_t row : set) box.add(points_[row]);
    const double half = box.half_size();
    const bool light = set.size() <= options_.weight || half < options_.smallest;
    if ((light && 2 * half <= options_.size) || !split(set, box, box.lo + half)) emit(set, box);
  }

  // False when rounding leaves nothing to split.
  bool split(Rows set, const PlanBox& box, const Vec2d& mid) {
    const bool apart = (mid.x > box.lo.x && mid.x <= box.hi.x) || (mid.y > box.lo.y && mid.y <= box.hi.y);
    if (!apart) return false;
    const auto below = [&](std::uint32_t row) { return points_[row].y < mid.y; };
    const auto left = [&](std::uint32_t row) { return points_[row].x < mid.x; };
    const auto upper = std::partition(set.begin(), set.end(), below);
    const std::array<Rows, 2> halves{Rows(set.begin(), upper), Rows(upper, set.end())};
    for (auto h = halves.rbegin(); h != halves.rend(); ++h) {
      const auto right = std::partition(h->begin(), h->end(), left);
      push(Rows(right, h->end()));
      push(Rows(h->begin(), right));
    }
    return true;
  }

  void push(Rows set) {
    if (!set.empty()) todo_.push_back(set);
  }

  void emit(Rows set, const PlanBox& box) {
    for (std::uint32_t row : set) result_.of[row] = static_cast<std::uint32_t>(result_.cells.size());
    result_.cells.push_back(box);
  }

  std::span<const Vec2d> points_;
  CellOptions options_;
  std::vector<Rows> todo_;  // a stack, so that depth costs no call frames
  FallbackCells result_;
};

}  // namespace

FallbackCells fallback_cells(std::span<const Vec2d> points, const CellOptions& options) {
  return Splitter(points, options).run();
}

}  // namespace manzana

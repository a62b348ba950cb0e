#include "foliage/import/join_lines.h"

#include <algorithm>
#include <numeric>

#include "foliage/import/nearest_branch.h"
#include "foliage/sets.h"

namespace manzana::foliage {
namespace {

using Line = std::vector<CentrePoint>;

LineTree tree_of(const std::vector<Line>& lines) {
  std::vector<Branch> branches;
  std::vector<CentrePoint> points;
  for (const Line& line : lines) {
    Branch b;
    b.line.first = static_cast<std::uint32_t>(points.size());
    points.insert(points.end(), line.begin(), line.end());
    b.line.last = static_cast<std::uint32_t>(points.size());
    branches.push_back(b);
  }
  return {branches, points};
}

/// Mean radius of the first half of the points.
float thickness(const Line& line, bool from_back) {
  const std::size_t half = (line.size() + 1) / 2;
  float sum = 0;
  for (std::size_t i = 0; i < half; ++i) sum += line[from_back ? line.size() - 1 - i : i].radius;
  return sum / static_cast<float>(half);
}

void turn_to_foot(std::vector<Line>& lines) {
  constexpr float kAlike = 0.05F;
  const LineTree tree = tree_of(lines);
  for (std::uint32_t i = 0; i < lines.size(); ++i) {
    Line& line = lines[i];
    float first = thickness(line, false), last = thickness(line, true);
    if (std::abs(first - last) <= kAlike * std::max(first, last)) {
      const auto other = [&](std::uint32_t b) { return b != i; };
      first = -tree.nearest(line.front().position, false, other).distance;
      last = -tree.nearest(line.back().position, false, other).distance;
      if (first == last) first = -line.front().position.z, last = -line.back().position.z;
    }
    if (last > first) std::reverse(line.begin(), line.end());
  }
}

class Joiner {
 public:
  explicit Joiner(const std::vector<Line>& lines) : lines_(lines) {
    for (const Line& line : lines)
      for (const CentrePoint& p : line) low_ = std::min(low_, p.position.z), high_ = std::max(high_, p.position.z);
  }

  /// Thin lines choose first, among lines that do not hang on them: so no cycle can close, and what a line should hang
  /// on, being thicker, hangs on nothing yet.
  std::vector<std::int32_t> parents() const {
    std::vector<std::int32_t> parent(lines_.size(), -1);
    const std::uint32_t trunk = thickest_near_ground();
    const LineTree tree = tree_of(lines_);
    Sets together(lines_.size());
    for (const std::uint32_t i : thin_first()) {
      if (i == trunk) continue;
      const std::uint32_t own = together.find(i);
      const auto found = tree.nearest(foot(i).position, true, [&](std::uint32_t b) { return together.find(b) != own; });
      if (stands_alone(i, found.distance)) continue;
      parent[i] = static_cast<std::int32_t>(found.branch);
      together.join(i, found.branch);
    }
    return parent;
  }

 private:
  const CentrePoint& foot(std::uint32_t line) const { return lines_[line].front(); }
  bool near_ground(std::uint32_t line, float share) const {
    return foot(line).position.z <= low_ + share * (high_ - low_);
  }

  bool stands_alone(std::uint32_t line, float distance) const {
    constexpr float kGround = 0.02F;  // of the height
    return near_ground(line, kGround) && distance > foot(line).radius;
  }

  std::uint32_t thickest_near_ground() const {
    constexpr float kGround = 0.05F;
    std::uint32_t best = 0;
    for (std::uint32_t i = 1; i < lines_.size(); ++i) {
      const bool low = near_ground(i, kGround), best_low = near_ground(best, kGround);
      if (low != best_low ? low : foot(i).radius > foot(best).radius) best = i;
    }
    return best;
  }

  std::vector<std::uint32_t> thin_first() const {
    std::vector<std::uint32_t> order(lines_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return foot(a).radius < foot(b).radius; });
    return order;
  }

  const std::vector<Line>& lines_;
  float low_ = HUGE_VALF, high_ = -HUGE_VALF;
};

/// Rows by walking down from the roots; children in the order of their lines.
JoinedLines rows_of(const std::vector<std::int32_t>& parent) {
  std::vector<std::vector<std::uint32_t>> children(parent.size() + 1);
  for (std::uint32_t i = 0; i < parent.size(); ++i) children[static_cast<std::size_t>(parent[i] + 1)].push_back(i);
  struct Next {
    std::uint32_t line;
    std::int32_t parent;
  };
  JoinedLines out;
  std::vector<Next> todo;
  const auto push = [&](const std::vector<std::uint32_t>& lines, std::int32_t row) {
    for (auto line = lines.rbegin(); line != lines.rend(); ++line) todo.push_back({*line, row});
  };
  push(children[0], -1);
  while (!todo.empty()) {
    const Next next = todo.back();
    todo.pop_back();
    const auto row = static_cast<std::int32_t>(out.order.size());
    out.order.push_back(next.line);
    out.parent.push_back(next.parent);
    const int level = next.parent < 0 ? 0 : out.level[static_cast<std::size_t>(next.parent)] + 1;
    out.level.push_back(static_cast<std::uint16_t>(std::min(level, 65535)));
    push(children[next.line + std::size_t{1}], row);
  }
  return out;
}

}  // namespace

JoinedLines join_lines(std::vector<std::vector<CentrePoint>>& lines) {
  if (lines.empty()) return {};
  turn_to_foot(lines);
  return rows_of(Joiner(lines).parents());
}

}  // namespace manzana::foliage

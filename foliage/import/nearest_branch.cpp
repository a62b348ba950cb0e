#include "foliage/import/nearest_branch.h"

#include <algorithm>

namespace manzana::foliage {
namespace {

constexpr float kInside = 0.1F;  // of the distance to the axis
constexpr std::uint32_t kLeaf = 4;

float to_surface(float to_axis, float radius) { return std::max(to_axis - radius, 0.0F) + kInside * to_axis; }

}  // namespace

LineTree::LineTree(std::span<const Branch> branches, std::span<const CentrePoint> points) {
  for (std::uint32_t b = 0; b < branches.size(); ++b)
    for (std::uint32_t i = branches[b].line.first; i + 1 < branches[b].line.last; ++i)
      pieces_.push_back({points[i], points[i + 1], b, i == branches[b].line.first});
  build();
}

float LineTree::least(const Node& node, const Vec3& place) {
  return to_surface(glm::length(glm::max(glm::max(node.low - place, place - node.high), Vec3(0))), node.radius);
}

void LineTree::take(const LinePiece& piece, const Vec3& place, bool foot_counts, Found& best) {
  const Vec3 along = piece.b.position - piece.a.position;
  const float length2 = glm::dot(along, along);
  const float t = length2 > 0 ? std::clamp(glm::dot(place - piece.a.position, along) / length2, 0.0F, 1.0F) : 0.0F;
  const float radius = glm::mix(piece.a.radius, piece.b.radius, t);
  float distance = to_surface(glm::length(place - piece.a.position - along * t), radius);
  if (foot_counts && piece.foot && t == 0) distance += piece.a.radius;
  if (distance < best.distance || (distance == best.distance && piece.branch < best.branch))
    best = {piece.branch, distance};
}

void LineTree::grow(const LinePiece& piece, Node& node) const {
  for (const CentrePoint& p : {piece.a, piece.b}) {
    node.low = glm::min(node.low, p.position);
    node.high = glm::max(node.high, p.position);
    node.radius = std::max(node.radius, p.radius);
  }
}

/// Halves at the median of the middles, along the longest side of the box.
void LineTree::build() {
  if (pieces_.empty()) return;
  nodes_.push_back({});
  nodes_[0].last = static_cast<std::uint32_t>(pieces_.size());
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    Node node = nodes_[n];
    for (std::uint32_t i = node.first; i < node.last; ++i) grow(pieces_[i], node);
    if (node.last - node.first > kLeaf) {
      const Vec3 size = node.high - node.low;
      const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
      const std::uint32_t half = node.first + (node.last - node.first) / 2;
      const auto at = [&](std::uint32_t i) { return pieces_.begin() + static_cast<std::ptrdiff_t>(i); };
      std::nth_element(at(node.first), at(half), at(node.last), [&](const LinePiece& p, const LinePiece& q) {
        return p.a.position[axis] + p.b.position[axis] < q.a.position[axis] + q.b.position[axis];
      });
      node.left = static_cast<std::uint32_t>(nodes_.size());
      nodes_.push_back({});
      nodes_.back().first = node.first, nodes_.back().last = half;
      nodes_.push_back({});
      nodes_.back().first = half, nodes_.back().last = node.last;
    }
    nodes_[n] = node;
  }
}

}  // namespace manzana::foliage

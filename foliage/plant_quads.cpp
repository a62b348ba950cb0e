#include "foliage/plant_quads.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace manzana::foliage {
namespace {

constexpr std::uint32_t kNone = ~0U;

/// Side `side` of a triangle goes from its corner `side` to the next.
struct Edge {
  std::uint32_t low, high;  // vertices
  std::uint32_t triangle, side;
  bool rising;  // from low to high
};

std::vector<Edge> sorted_edges(std::span<const std::uint32_t> indices) {
  std::vector<Edge> edges;
  edges.reserve(indices.size());
  for (std::uint32_t i = 0; i < indices.size(); ++i) {
    const std::uint32_t t = i / 3, side = i % 3, a = indices[i], b = indices[3 * t + (side + 1) % 3];
    edges.push_back({std::min(a, b), std::max(a, b), t, side, a < b});
  }
  const auto key = [](const Edge& e) { return std::tuple(e.low, e.high, e.triangle, e.side); };
  std::sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) { return key(a) < key(b); });
  return edges;
}

struct Neighbour {
  std::uint32_t triangle = kNone, side = 0;
};

/// Across each side, where just two triangles meet there and agree about the front.
std::vector<Neighbour> neighbours(std::span<const std::uint32_t> indices) {
  std::vector<Neighbour> across(indices.size());
  const std::vector<Edge> edges = sorted_edges(indices);
  for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
    while (end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high) ++end;
    if (end - i != 2 || edges[i].rising == edges[i + 1].rising || edges[i].triangle == edges[i + 1].triangle) continue;
    for (const auto& [from, to] : {std::pair(edges[i], edges[i + 1]), std::pair(edges[i + 1], edges[i])})
      across[3 * from.triangle + from.side] = {to.triangle, to.side};
  }
  return across;
}

/// Pairs triangles greedily: those with one free neighbour left first, since they can wait for no other.
class Pairing {
 public:
  explicit Pairing(std::span<const std::uint32_t> indices)
      : across_(neighbours(indices)), partner_side_(indices.size() / 3, kNone), taken_(indices.size() / 3, false) {}

  void run() {
    const auto count = static_cast<std::uint32_t>(taken_.size());
    for (std::uint32_t t = 0; t < count; ++t)
      if (free_sides(t) == 1) follow(t);
    for (std::uint32_t t = 0; t < count; ++t)
      if (!taken_[t]) follow(t);
  }

  /// The side that a quad's first triangle shares with its second; kNone for all others.
  std::uint32_t partner_side(std::uint32_t t) const { return partner_side_[t]; }
  const Neighbour& across(std::uint32_t t, std::uint32_t side) const { return across_[3 * t + side]; }
  bool alone_or_first(std::uint32_t t) const { return !taken_[t] || partner_side_[t] != kNone; }

 private:
  bool is_free(std::uint32_t t) const { return t != kNone && !taken_[t]; }

  std::uint32_t free_sides(std::uint32_t t) const {
    std::uint32_t sides = 0;
    for (std::uint32_t s = 0; s < 3; ++s) sides += is_free(across(t, s).triangle) ? 1 : 0;
    return sides;
  }

  /// The free neighbour with the fewest others; kNone without any.
  std::uint32_t best_side(std::uint32_t t) const {
    std::uint32_t best = kNone;
    for (std::uint32_t s = 0; s < 3; ++s) {
      if (!is_free(across(t, s).triangle)) continue;
      if (best == kNone || free_sides(across(t, s).triangle) < free_sides(across(t, best).triangle)) best = s;
    }
    return best;
  }

  /// Pairs t, then whoever is left with one free neighbour by that, and so on.
  void follow(std::uint32_t t) {
    std::vector<std::uint32_t> todo{t};
    while (!todo.empty()) {
      const std::uint32_t a = todo.back();
      todo.pop_back();
      const std::uint32_t side = taken_[a] ? kNone : best_side(a);
      if (side == kNone) continue;
      const std::uint32_t b = across(a, side).triangle;
      taken_[a] = taken_[b] = true;
      partner_side_[a] = side;
      for (const std::uint32_t pair : {a, b})
        for (std::uint32_t s = 0; s < 3; ++s)
          if (const std::uint32_t near = across(pair, s).triangle; is_free(near) && free_sides(near) == 1)
            todo.push_back(near);
    }
  }

  std::vector<Neighbour> across_;
  std::vector<std::uint32_t> partner_side_;
  std::vector<bool> taken_;
};

PlantQuad make_quad(const MeshPart& part, const std::array<std::uint32_t, 4>& corners, const QuadTraits& traits) {
  PlantQuad quad{};
  quad.anchor = traits.anchor;
  for (std::size_t i = 0; i < 4; ++i) {
    const MeshVertex& v = part.vertices[corners[i]];
    quad.corners[i] = {v.position, pack_uv(v.uv.x), pack_uv(v.uv.y)};
    quad.normals[i] = pack_normal(v.normal) | (std::min(traits.level, 3U) << 30);
    quad.shades[i] = pack_shade(v.shade);
  }
  return quad;
}

}  // namespace

void add_quads(const MeshPart& part, std::span<const std::uint32_t> indices, const QuadTraits& traits,
               std::vector<PlantQuad>& out) {
  Pairing pairing(indices);
  pairing.run();
  const auto corner = [&](std::uint32_t t, std::uint32_t side) { return indices[3 * t + side % 3]; };
  for (std::uint32_t t = 0; t < indices.size() / 3; ++t) {
    if (!pairing.alone_or_first(t)) continue;
    const std::uint32_t side = pairing.partner_side(t);
    if (side == kNone) {
      out.push_back(make_quad(part, {corner(t, 0), corner(t, 1), corner(t, 2), corner(t, 2)}, traits));
      continue;
    }
    const Neighbour& other = pairing.across(t, side);  // the shared edge is the diagonal 0-2
    out.push_back(make_quad(
        part, {corner(t, side), corner(other.triangle, other.side + 2), corner(t, side + 1), corner(t, side + 2)},
        traits));
  }
}

}  // namespace manzana::foliage

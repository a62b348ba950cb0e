#include "scenegraph/import/town_lots.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "culling/hash.h"
#include "scenegraph/import/tree_species.h"

namespace manzana {
namespace {

constexpr std::array<std::uint32_t, 10> kPlaster = {0xe3d6bd, 0xd9c3a0, 0xcfae8a, 0xe8e2d4, 0xc98f6b,
                                                    0xb5654a, 0xd6cdb8, 0xbfc4c0, 0xe0c27f, 0xa85a42};
constexpr std::array<std::uint32_t, 4> kTiles = {0x8a4a35, 0x9c5a40, 0x6e4638, 0x5a5552};
constexpr std::array<std::uint32_t, 3> kFlat = {0x8d8a84, 0x77756f, 0x9a958a};

double cross(const Vec2d& a, const Vec2d& b) { return a.x * b.y - a.y * b.x; }

// Convex, counter-clockwise.
bool inside(const std::vector<Vec2d>& ring, const Vec2d& p, double margin = 0) {
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec2d e = ring[(k + 1) % ring.size()] - ring[k];
    if (cross(e, p - ring[k]) < margin * glm::length(e)) return false;
  }
  return true;
}

// Some edge of `a` has all of `b` on its outer side, or touching.
bool edge_separates(const std::vector<Vec2d>& a, const std::vector<Vec2d>& b) {
  for (std::size_t k = 0; k < a.size(); ++k) {
    const Vec2d e = glm::normalize(a[(k + 1) % a.size()] - a[k]);
    if (std::all_of(b.begin(), b.end(), [&](const Vec2d& p) { return cross(e, p - a[k]) < 0.05; })) return true;
  }
  return false;
}

class Filler {
 public:
  Filler(const std::vector<Vec2d>& ring, const LotStyle& style, CityFeatures& city)
      : ring_(ring), style_(style), city_(city) {}

  void run() {
    const std::size_t first = city_.buildings.size();
    for (std::size_t k = 0; k < ring_.size(); ++k) side(ring_[k], ring_[(k + 1) % ring_.size()]);
    if (style_.kind == LotKind::perimeter && unit() < 0.22) tower();
    gardens(first);
    city_.areas.push_back(
        {"block", {ring_, {}}, style_.kind == LotKind::perimeter ? Material::pavement : Material::grass, 0});
  }

 private:
  double unit() { return hash_unit(style_.seed, counter_++); }
  double within(double low, double high) { return low + (high - low) * unit(); }
  template <std::size_t N>
  std::uint32_t pick(const std::array<std::uint32_t, N>& colours) {
    return colours[static_cast<std::size_t>(unit() * N)];
  }

  // Lots along one side of the block, left to right; a lot that does not fit is given up.
  void side(const Vec2d& a, const Vec2d& b) {
    const Vec2d d = glm::normalize(b - a), n{-d.y, d.x};
    const double length = glm::length(b - a);
    for (double s = start(); s < length - 6;) {
      const double w = std::min(lot_width(), length - s);
      lot(a + s * d, d, n, w);
      s += w + gap();
    }
  }
  double start() { return style_.kind == LotKind::houses ? 3 : 0; }
  double lot_width() {
    return style_.kind == LotKind::perimeter ? within(12, 18)
           : style_.kind == LotKind::rows    ? within(8.5, 12.5)
                                             : within(9, 12.5);
  }
  double gap() {
    return style_.kind == LotKind::perimeter ? 0
           : style_.kind == LotKind::rows    ? (unit() < 0.2 ? 5.0 : 0.0)
                                             : within(4, 7);
  }

  void lot(const Vec2d& corner, const Vec2d& d, const Vec2d& n, double width) {
    const double depth = style_.kind == LotKind::perimeter ? within(12, 14)
                         : style_.kind == LotKind::rows    ? within(9.5, 11)
                                                           : within(8, 10.5);
    const double set_back = style_.kind == LotKind::houses ? within(3, 6) : style_.kind == LotKind::rows ? 0.8 : 0;
    const Vec2d center = corner + d * (width / 2) + n * (set_back + depth / 2);
    const std::vector<Vec2d> foot = rectangle(center, d, width, depth);
    if (fits(foot)) build(foot, std::min(width, depth));
  }

  bool fits(const std::vector<Vec2d>& foot) const {
    for (const Vec2d& p : foot)
      if (!inside(ring_, p, -0.05)) return false;
    for (const auto& other : placed_)
      if (!edge_separates(foot, other) && !edge_separates(other, foot)) return false;
    return true;
  }

  void build(const std::vector<Vec2d>& foot, double span) {
    const int levels = style_.min_levels + static_cast<int>(unit() * (style_.max_levels - style_.min_levels + 1));
    BuildingFeature b;
    b.where = "building " + std::to_string(city_.buildings.size());
    b.footprint.outer = foot;
    b.levels = levels;
    b.wall_rgb = pick(kPlaster);
    const bool flat = style_.kind == LotKind::perimeter && unit() < 0.55;
    b.roof = flat                                                   ? RoofShape::flat
             : unit() < (style_.kind == LotKind::rows ? 0.95 : 0.6) ? RoofShape::gabled
                                                                    : RoofShape::hipped;
    b.roof_rgb = flat ? pick(kFlat) : pick(kTiles);
    b.roof_height = flat ? 0 : span * within(0.3, 0.42);
    b.height = 0.6 + levels * 3.1 + b.roof_height;
    city_.buildings.push_back(std::move(b));
    placed_.push_back(foot);
  }

  // In the court, over the roofs.
  void tower() {
    Vec2d middle{0, 0};
    for (const Vec2d& p : ring_) middle += p / static_cast<double>(ring_.size());
    const Vec2d d = glm::normalize(ring_[1] - ring_[0]);
    const std::vector<Vec2d> foot = rectangle(middle, d, within(17, 22), within(15, 18));
    if (!fits(foot)) return;
    const int levels = 11 + static_cast<int>(unit() * 9);
    city_.buildings.push_back({"tower " + std::to_string(city_.buildings.size()),
                               {foot, {}},
                               1 + levels * 3.2,
                               0,
                               0,
                               levels,
                               RoofShape::flat,
                               unit() < 0.5 ? 0xb9c2c8U : 0xd5d2caU,
                               0x6f7274});
    placed_.push_back(foot);
  }

  void gardens(std::size_t first) {
    const int tries = style_.kind == LotKind::houses ? 16 : style_.kind == LotKind::rows ? 11 : 5;
    Vec2d low = ring_[0], high = ring_[0];
    for (const Vec2d& p : ring_) low = glm::min(low, p), high = glm::max(high, p);
    for (int k = 0; k < tries; ++k) {
      const Vec2d p{within(low.x, high.x), within(low.y, high.y)};
      const double u = unit(), height = within(4, 10);
      if (!inside(ring_, p, 1.5) || near_building(first, p, 3.2)) continue;
      const PlantKind kind = u < 0.62 ? PlantKind::broadleaf : u < 0.75 ? PlantKind::conifer : PlantKind::shrub;
      const PlantSpecies species = species_for(kind, TreePlace::garden, hash_bits(style_.seed + 1, counter_));
      city_.trees.push_back(free_tree(p, kind == PlantKind::shrub ? 1 + height / 8 : height, species));
    }
  }
  bool near_building(std::size_t first, const Vec2d& p, double margin) const {
    for (std::size_t b = first; b < city_.buildings.size(); ++b)
      if (inside(city_.buildings[b].footprint.outer, p, -margin)) return true;
    return false;
  }

  const std::vector<Vec2d>& ring_;
  LotStyle style_;
  CityFeatures& city_;
  std::vector<std::vector<Vec2d>> placed_;
  std::uint64_t counter_ = 0;
};

}  // namespace

std::vector<Vec2d> inset_ring(const std::vector<Vec2d>& ring, const std::vector<double>& inset) {
  const std::size_t n = ring.size();
  std::vector<Vec2d> result;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t before = (k + n - 1) % n;
    const Vec2d d0 = glm::normalize(ring[k] - ring[before]), d1 = glm::normalize(ring[(k + 1) % n] - ring[k]);
    const Vec2d p0 = ring[k] + inset[before] * Vec2d(-d0.y, d0.x), p1 = ring[k] + inset[k] * Vec2d(-d1.y, d1.x);
    const double turn = cross(d0, d1);
    result.push_back(std::abs(turn) < 0.05 ? p1 : p0 + d0 * (cross(p1 - p0, d1) / turn));
  }
  // Each edge must still run its own way, else the ring has turned inside out.
  for (std::size_t k = 0; k < n; ++k)
    if (glm::dot(result[(k + 1) % n] - result[k], ring[(k + 1) % n] - ring[k]) <= 0) return {};
  return result;
}

std::vector<Vec2d> rectangle(const Vec2d& c, const Vec2d& d, double length, double width) {
  const Vec2d x = d * (length / 2), y = Vec2d(-d.y, d.x) * (width / 2);
  return {c - x - y, c + x - y, c + x + y, c - x + y};
}

void fill_block(const std::vector<Vec2d>& ring, const LotStyle& style, CityFeatures& city) {
  Filler(ring, style, city).run();
}

}  // namespace manzana

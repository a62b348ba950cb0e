#include "foliage/neighbours.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace manzana::foliage {
namespace {

constexpr std::uint32_t kAzimuths = glsl::kLeewayAzimuths, kHeights = 4;
const double kReach = static_cast<double>(glsl::kLeewayReach);
constexpr double kLeastHalf = 1;      // metres: what is lower hides no trees, and is too small to see where it matters
constexpr std::size_t kSamples = 16;  // of a crown as it is seen from a side

/// An ellipsoid that lets through as much light as the plant does, seen from its sides.
struct Crown {
  Vec3d middle;
  double radius, half_height, opacity;
};

/// Well spread over the unit disk.
std::array<Vec2d, kSamples> make_disk() {
  std::array<Vec2d, kSamples> disk;
  for (std::size_t i = 0; i < disk.size(); ++i) {
    const double r = std::sqrt((static_cast<double>(i) + 0.5) / kSamples);
    const double angle = std::numbers::pi * (3 - std::sqrt(5.0)) * static_cast<double>(i);
    disk[i] = {r * std::cos(angle), r * std::sin(angle)};
  }
  return disk;
}

/// Where sight goes from the tree to the eye; rise: metres a metre.
struct Side {
  Vec2d towards;
  std::array<double, kHeights> rise;
};

/// As select.glsl's leeway_of() has them.
std::array<Side, kAzimuths> make_sides() {
  std::array<Side, kAzimuths> sides;
  for (std::uint32_t a = 0; a < kAzimuths; ++a) {
    const double quarter = kAzimuths / 4.0,
                 at = std::fmod(a, quarter) / quarter;  // on a square that stands on a corner
    Vec2d towards(1 - at, at);
    for (std::uint32_t turns = 4 * a / kAzimuths; turns > 0; --turns) towards = {-towards.y, towards.x};
    sides[a].towards = glm::normalize(towards);
    const double both = std::abs(sides[a].towards.x) + std::abs(sides[a].towards.y);
    for (std::uint32_t h = 0; h < kHeights; ++h)
      sides[a].rise[h] = both * h / (static_cast<double>(glsl::kLeewaySteepness) * (kHeights - h));
  }
  return sides;
}

/// What of each sample of a tree is seen past its neighbours, from each side and height.
class Sight {
 public:
  explicit Sight(const Crown& tree) : tree_(tree) { seen_.fill(1); }

  void add(const Crown& other, const Vec3d& offset) {
    static const auto sides = make_sides();
    for (std::uint32_t a = 0; a < kAzimuths; ++a) {
      const Vec2d& towards = sides[a].towards;
      const double along = offset.x * towards.x + offset.y * towards.y;
      const double beside = offset.y * towards.x - offset.x * towards.y;
      if (along <= 0 || std::abs(beside) > tree_.radius + other.radius) continue;
      for (std::uint32_t h = 0; h < kHeights; ++h)
        add(other, beside, offset.z - along * sides[a].rise[h], sides[a].rise[h],
            &seen_[(a * kHeights + h) * kSamples]);
    }
  }
  double hidden(std::uint32_t azimuth, std::uint32_t height) const {
    const double* seen = &seen_[(azimuth * kHeights + height) * kSamples];
    return 1 - std::accumulate(seen, seen + kSamples, 0.0) / kSamples;
  }

 private:
  /// The other's middle is so far beside and above the tree's, along a sight that rises.
  void add(const Crown& other, double beside, double above, double rise, double* seen) const {
    static const auto disk = make_disk();
    const double half = std::hypot(tree_.half_height, tree_.radius * rise);
    const double other_half = std::hypot(other.half_height, other.radius * rise);
    if (std::abs(above) > half + other_half) return;
    for (std::size_t i = 0; i < kSamples; ++i) {
      const Vec2d p((beside - disk[i].x * tree_.radius) / other.radius, (above - disk[i].y * half) / other_half);
      if (glm::dot(p, p) < 1) seen[i] *= 1 - other.opacity;
    }
  }

  const Crown& tree_;
  std::array<double, kAzimuths * kHeights * kSamples> seen_;
};

/// Columns: the axes of the site's block.
glm::dmat3 axes_of(const TreeSite& site, std::span<const Vec4> rows) {
  const std::size_t first = std::size_t{site.block} * 3;
  return glm::transpose(glm::dmat3(Vec3d(rows[first]), Vec3d(rows[first + 1]), Vec3d(rows[first + 2])));
}

Crown crown_of(const TreeSite& site, const PreparedPlant& plant, std::span<const Vec4> rows) {
  constexpr double kDensest = 0.95;
  const auto radius = static_cast<double>(plant.crown_radius_m), half = static_cast<double>(plant.height_m) / 2;
  const auto height = half * static_cast<double>(site.height);
  const std::size_t first = std::size_t{site.block} * 3;
  const Vec4d foot(Vec3d(site.position) + Vec3d(0, 0, height), 1);
  const Vec3d middle(glm::dot(Vec4d(rows[first]), foot), glm::dot(Vec4d(rows[first + 1]), foot),
                     glm::dot(Vec4d(rows[first + 2]), foot));
  return {middle, radius * static_cast<double>(site.radius), height,
          std::min(kDensest, static_cast<double>(plant.cover_m2) / (std::numbers::pi * radius * half))};
}

/// Crowns in strips as wide as sight reaches, each from one end to the other.
class Strips {
 public:
  explicit Strips(std::span<const Crown> crowns) {
    for (const Crown& crown : crowns)
      if (crown.half_height >= kLeastHalf) strips_[strip_of(crown)].push_back(&crown);
    for (auto& [number, strip] : strips_)
      std::sort(strip.begin(), strip.end(), [](const Crown* a, const Crown* b) { return a->middle.y < b->middle.y; });
  }
  template <class F>
  void for_each_near(const Crown& tree, F&& f) const {
    const std::int64_t middle = strip_of(tree);
    for (auto at = strips_.lower_bound(middle - 1); at != strips_.end() && at->first <= middle + 1; ++at) {
      const std::vector<const Crown*>& strip = at->second;
      auto crown = std::lower_bound(strip.begin(), strip.end(), tree.middle.y - kReach,
                                    [](const Crown* c, double y) { return c->middle.y < y; });
      for (; crown != strip.end() && (*crown)->middle.y <= tree.middle.y + kReach; ++crown) f(**crown);
    }
  }

 private:
  static std::int64_t strip_of(const Crown& crown) {
    return static_cast<std::int64_t>(std::floor(crown.middle.x / kReach));
  }
  std::map<std::int64_t, std::vector<const Crown*>> strips_;
};

void write(const Sight& sight, TreeSite& site) {
  for (std::uint32_t a = 0; a < kAzimuths; ++a) {
    site.leeway[a] = 0;
    for (std::uint32_t h = 0; h < kHeights; ++h) {
      const double more = leeway(sight.hidden(a, h)) / static_cast<double>(glsl::kMostLeeway);
      site.leeway[a] |= static_cast<std::uint32_t>(std::lround(255 * std::min(more, 1.0))) << (8 * h);
    }
  }
}

}  // namespace

double leeway(double hidden) { return static_cast<double>(glsl::kMostLeeway) * hidden; }

void see_neighbours(std::span<TreeSite> sites, std::span<const PreparedPlant> plants,
                    std::span<const Vec4> block_rows) {
  std::vector<Crown> crowns;
  crowns.reserve(sites.size());
  for (const TreeSite& site : sites) crowns.push_back(crown_of(site, plants[site.plant], block_rows));
  const Strips strips(crowns);
  tbb::parallel_for(std::size_t{0}, sites.size(), [&](std::size_t i) {
    const Crown& tree = crowns[i];
    if (tree.half_height < kLeastHalf) return;
    const glm::dmat3 to_block = glm::transpose(axes_of(sites[i], block_rows));
    Sight sight(tree);
    strips.for_each_near(tree, [&](const Crown& other) {
      const Vec3d offset = to_block * (other.middle - tree.middle);
      if (&other != &tree && std::hypot(offset.x, offset.y) < kReach) sight.add(other, offset);
    });
    write(sight, sites[i]);
  });
}

}  // namespace manzana::foliage

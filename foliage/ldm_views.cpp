#include "foliage/ldm_views.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "foliage/octahedral.h"

namespace manzana::foliage {
namespace {

constexpr std::uint32_t kGridSide = 5;
// At 0.6 an oak 64 px high is 290 mosaics, where barycentric weights show 500, and looks truer (SSIM 0.66 against 0.64
// at four samples a pixel, cover 0.99 against 0.98).
constexpr float kLeftOut = 0.6F;
constexpr double kZone = 0.75;  // of a level's far distance: where the next begins to show

/// One above, five at half height, nine near the ground: about 40 degrees from each to the next.
std::vector<Vec3d> paper_directions() {
  std::vector<Vec3d> all{{0, 0, 1}};
  const auto ring = [&](int n, double elevation_deg, double turn) {
    const double e = elevation_deg * std::numbers::pi / 180;
    for (int i = 0; i < n; ++i) {
      const double a = 2 * std::numbers::pi * (i + turn) / n;
      all.emplace_back(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
    }
  };
  ring(5, 50, 0.5);
  ring(9, 10, 0);
  return all;
}

/// Vertices of the grid, of each pair on its rim the first; and which of them each vertex is.
struct Grid {
  std::vector<Vec3d> directions;
  std::array<std::uint32_t, kGridSide * kGridSide> side_of{};
};

const Grid& grid() {
  static const Grid made = [] {
    Grid grid;
    for (std::uint32_t v = 0; v < grid.side_of.size(); ++v) {
      const Vec3d d = grid_direction(kGridSide, v % kGridSide, v / kGridSide);
      const auto same = [&](const Vec3d& other) { return glm::dot(other, d) > 1 - 1e-9; };
      const auto at = std::find_if(grid.directions.begin(), grid.directions.end(), same);
      grid.side_of[v] = static_cast<std::uint32_t>(at - grid.directions.begin());
      if (at == grid.directions.end()) grid.directions.push_back(d);
    }
    return grid;
  }();
  return made;
}

/// Less a share of what the largest has: one side alone is shown from most places.
LdmWeights sharpened(LdmWeights weights) {
  const float most = std::max({weights.weight[0], weights.weight[1], weights.weight[2]});
  float sum = 0;
  for (float& w : weights.weight) sum += w = std::max(0.0F, w - kLeftOut * most);
  for (float& w : weights.weight) w /= sum;
  return weights;
}

LdmWeights grid_sides(const Vec3& to_eye) {
  const GridWeights at = grid_weights(kGridSide, to_eye);
  LdmWeights weights;
  for (std::size_t i = 0; i < 3; ++i) {
    weights.side[i] = grid().side_of[at.vertex[i]];
    weights.weight[i] = static_cast<float>(at.weight[i]) / 256;
  }
  return sharpened(weights);
}

}  // namespace

std::vector<Vec3d> ldm_directions(LdmSides sides) {
  return sides == LdmSides::paper ? paper_directions() : grid().directions;
}

double adjusting_curve(double cos_alpha) {
  const double t = std::clamp(cos_alpha, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

LdmWeights ldm_weights(const LdmPack& pack, const Vec3& to_eye) {
  if (pack.options.sides == LdmSides::octahedral) return grid_sides(to_eye);
  struct Found {
    double cosine = -2;
    std::uint32_t side = 0;
  };
  std::array<Found, 5> best;  // the last: room for what falls out
  const Vec3d eye = glm::normalize(Vec3d(to_eye));
  for (std::uint32_t i = 0; i < pack.sides.size(); ++i) {
    best[4] = {glm::dot(eye, Vec3d(pack.sides[i].towards)), i};
    for (std::size_t k = 4; k > 0 && best[k].cosine > best[k - 1].cosine; --k) std::swap(best[k], best[k - 1]);
  }
  LdmWeights weights;
  double sum = 0;
  std::array<double, 3> share{};
  for (std::size_t i = 0; i < 3; ++i) {
    weights.side[i] = best[i].side;
    sum += share[i] = adjusting_curve(best[i].cosine) - adjusting_curve(best[3].cosine);
  }
  if (sum <= 0) return {weights.side, {1, 0, 0}};
  for (std::size_t i = 0; i < 3; ++i) weights.weight[i] = static_cast<float>(share[i] / sum);
  return weights;
}

LdmZone::LdmZone(double begin_m, double end_m) : begin(begin_m), end(end_m) {
  if (!(begin <= end)) throw std::invalid_argument("a zone between two levels ends before it begins");
}

float LdmZone::next(double distance) const {
  if (distance >= end) return 1;
  if (distance <= begin) return 0;
  return static_cast<float>((distance - begin) / (end - begin));
}

LdmRing ldm_ring(const LdmPack& pack, double distance) {
  const int levels = level_count(pack.options);
  for (int level = pack.options.nearest; level + 1 < levels; ++level) {
    const double end = pack.distance_of(level + 1);
    const float next = LdmZone(kZone * end, end).next(distance);
    if (next < 1) return {level, next};
  }
  return {levels - 1, 0};
}

}  // namespace manzana::foliage

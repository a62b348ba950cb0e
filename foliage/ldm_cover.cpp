#include "foliage/ldm_cover.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "foliage/ldm_views.h"
#include "foliage/parallel_view.h"

namespace manzana::foliage {
namespace {

constexpr int kDirections = 24, kMostPixels = 192;
constexpr float kLeastGrown = -0.4F, kMostGrown = 1;

using vec3 = Vec3;
using glm::dot;
using glm::findMSB;
using std::max;
using std::min;
using uint = std::uint32_t;
#include "foliage/shaders/ldm_turn.glsl"

/// What is still open of each pixel of a picture as mosaics are put into it, in any order.
class Sheet {
 public:
  Sheet(const LdmPack& pack, const Vec3d& to_eye, int pixels)
      : view_(to_eye, pack.centre, pack.radius, pixels),
        open_(static_cast<std::size_t>(pixels) * static_cast<std::size_t>(pixels), 1.0F) {}

  void add(const LdmPack& pack, const LdmAlphas& alphas, const LdmSide& side, const LdmMosaic& mosaic, float grown) {
    const LdmBlock& block = pack.blocks[mosaic.block];
    const float unit = 2 * pack.radius / kLdmPixels, pixel = block.pixel * unit;
    const Vec2 low(mosaic.left, mosaic.low), high(mosaic.right, mosaic.high), half = 0.5F * (high - low);
    const Vec2 middle = pixel * (Vec2(kLdmBlock * block.column, kLdmBlock * block.row) + low + half) - pack.radius;
    const float nearness = pack.radius * (1 - 2 * static_cast<float>(mosaic.depth) / 65535);
    const Vec2 at = view_.pixel(pack.centre + side.right * middle.x + side.up * middle.y + side.towards * nearness);
    const Vec2 right = across(side.right, side, grown), up = across(side.up, side, grown);
    const float reach = view_.pixels_of(pixel) * glm::length(right) * glm::length(half);
    const float size2 = glm::dot(right, right), pixel_px = view_.pixels_of(pixel);
    const float shrunk = std::ldexp(1.0F, -block.shrink), texels = shrunk / (pixel_px * std::sqrt(size2));
    const std::uint32_t most =
        ldm_most_level(mosaic.right - mosaic.left + 0U, mosaic.high - mosaic.low + 0U, block.shrink);
    const int level = std::clamp(static_cast<int>(std::log2(texels) + 0.5F), 0,
                                 std::min(kLdmShrinks - block.shrink, static_cast<int>(most)));
    const auto last = static_cast<float>(view_.pixels());
    for (int y = static_cast<int>(std::clamp(at.y - reach, 0.0F, last)); y < std::min(at.y + reach, last); ++y)
      for (int x = static_cast<int>(std::clamp(at.x - reach, 0.0F, last)); x < std::min(at.x + reach, last); ++x) {
        const Vec2 d = Vec2(x + 0.5F, y + 0.5F) - at;
        const Vec2 off = Vec2(glm::dot(d, right), glm::dot(d, up)) / (size2 * pixel_px);
        if (std::abs(off.x) > half.x || std::abs(off.y) > half.y) continue;
        const Vec2 texel = Vec2(block.x, block.y) + shrunk * (low + half + off);
        open_[static_cast<std::size_t>(y * view_.pixels() + x)] *= 1 - alphas.at(block, texel.x, texel.y, level);
      }
  }

  double covered() const {
    return 1 - std::accumulate(open_.begin(), open_.end(), 0.0) / static_cast<double>(open_.size());
  }

 private:
  /// Of an axis of a side's picture.
  Vec2 across(const Vec3& axis, const LdmSide& side, float grown) const {
    const Vec3 to_eye = glm::normalize(glm::cross(view_.right(), view_.up()));
    const Vec3 there = turned(axis, side.towards, to_eye, grown);
    return {glm::dot(there, view_.right()), glm::dot(there, view_.up())};
  }

  ParallelView view_;
  std::vector<float> open_;
};

/// As the ball has on the screen that the pack is made for, in the middle of where the level is shown.
int pixels_of(const LdmPack& pack, int level) {
  const double away = std::numbers::sqrt2 * pack.distance_of(level);
  return std::clamp(static_cast<int>(2 * static_cast<double>(pack.radius) * pack.options.focal_px / away), 8,
                    kMostPixels);
}

/// Of all directions together, the sides of each by their weights.
double cover_of_all(const LdmPack& pack, const LdmAlphas& alphas, std::span<const LdmSeenFrom> seen, int level,
                    float grown) {
  const auto cover_from = [&](const Vec3d& to_eye) {
    const LdmWeights weights = ldm_weights(pack, Vec3(to_eye));
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i)
      if (weights.weight[i] > 0)
        sum += static_cast<double>(weights.weight[i]) *
               ldm_cover(pack, alphas, weights.side[i], level, to_eye, grown, pixels_of(pack, level));
    return sum;
  };
  std::vector<double> covers(seen.size());
  tbb::parallel_for(std::size_t{0}, seen.size(), [&](std::size_t i) { covers[i] = cover_from(seen[i].to_eye); });
  return std::accumulate(covers.begin(), covers.end(), 0.0);
}

/// Where a line through what two sizes cover meets what is covered. As it is where size makes no difference.
float fitted(const LdmPack& pack, const LdmAlphas& alphas, std::span<const LdmSeenFrom> seen, int level) {
  double wanted = 0;
  for (const LdmSeenFrom& one : seen) wanted += one.cover;
  const auto missing = [&](float grown) { return wanted - cover_of_all(pack, alphas, seen, level, grown); };
  float a = 0, b = 0.3F;
  double at_a = missing(a), at_b = missing(b);
  for (int step = 0; step < 2 && std::abs(at_a - at_b) > 1e-4 * wanted; ++step) {
    const float next = std::clamp(b + (b - a) * static_cast<float>(at_b / (at_a - at_b)), kLeastGrown, kMostGrown);
    a = b, at_a = at_b;
    b = next, at_b = missing(b);
  }
  return std::abs(at_a) < std::abs(at_b) ? a : b;
}

}  // namespace

std::vector<Vec3d> ldm_fitting_directions() {
  std::vector<Vec3d> directions;
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  for (int i = 0; i < kDirections; ++i) {
    const double z = -0.1 + 1.0 * (i + 0.5) / kDirections, r = std::sqrt(1 - z * z);
    directions.emplace_back(r * std::cos(golden * i), r * std::sin(golden * i), z);
  }
  return directions;
}

LdmAlphas::LdmAlphas(const LdmPack& pack) {
  std::vector<float> finest;
  for (std::size_t i = 3; i < pack.level_begin(1); i += 4) finest.push_back(static_cast<float>(pack.colour[i]) / 255);
  levels_.push_back(std::move(finest));
  for (int side = kLdmPage / 2; levels_.size() <= kLdmShrinks; side /= 2) {
    const std::vector<float>& from = levels_.back();
    std::vector<float> half(from.size() / 4);
    const auto row = static_cast<std::size_t>(side);
    for (std::size_t i = 0; i < half.size(); ++i) {
      const std::size_t at = 4 * (i - i % row) + 2 * (i % row);
      half[i] = (from[at] + from[at + 1] + from[at + 2 * row] + from[at + 2 * row + 1]) / 4;
    }
    levels_.push_back(std::move(half));
  }
}

float LdmAlphas::at(const LdmBlock& block, float x, float y, int level) const {
  const int side = kLdmBlock >> block.shrink >> level, row = kLdmPage >> level;
  const float scale = std::ldexp(1.0F, -level), most = static_cast<float>(side - 1);
  const float u = std::clamp(scale * (x - block.x) - 0.5F, 0.0F, most);
  const float v = std::clamp(scale * (y - block.y) - 0.5F, 0.0F, most);
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const auto texel = [&](int dx, int dy) {
    const int column = (block.x >> level) + std::min(i + dx, side - 1);
    const int line = (block.page << 8 >> level) + (block.y >> level) + std::min(j + dy, side - 1);
    return levels_[static_cast<std::size_t>(level)][static_cast<std::size_t>(line * row + column)];
  };
  const float s = u - static_cast<float>(i), t = v - static_cast<float>(j);
  return (1 - t) * ((1 - s) * texel(0, 0) + s * texel(1, 0)) + t * ((1 - s) * texel(0, 1) + s * texel(1, 1));
}

double ldm_cover(const LdmPack& pack, const LdmAlphas& alphas, std::uint32_t side, int level, const Vec3d& to_eye,
                 float grown, int pixels) {
  Sheet sheet(pack, to_eye, pixels);
  const LdmSide& from = pack.sides[side];
  const Run& run = from.mosaics[static_cast<std::size_t>(level)];
  for (std::uint32_t i = run.first; i < run.last; ++i) sheet.add(pack, alphas, from, pack.mosaics[i], grown);
  return sheet.covered();
}

void fit_grown(LdmPack& pack, std::span<const LdmSeenFrom> seen) {
  if (pack.options.sides == LdmSides::paper) return;
  const LdmAlphas alphas(pack);
  for (int level = pack.options.nearest; level < level_count(pack.options); ++level)
    pack.grown[static_cast<std::size_t>(level)] = fitted(pack, alphas, seen, level);
}

}  // namespace manzana::foliage

#include "foliage/texel_mean.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "foliage/leaf_image.h"

namespace manzana::foliage {
namespace {

/// A convex polygon; a triangle cut by four lines has at most seven corners.
struct Polygon {
  std::array<Vec2d, 8> corners;
  std::size_t count = 0;
  void push(const Vec2d& p) { corners[count++] = p; }
  std::span<const Vec2d> all() const { return std::span(corners).first(count); }
};

/// What lies where sign * p[axis] >= sign * at.  [Sutherland and Hodgman 1974]
Polygon cut(const Polygon& in, int axis, double at, double sign) {
  Polygon out;
  for (std::size_t i = 0; i < in.count; ++i) {
    const Vec2d &a = in.corners[i], &b = in.corners[(i + 1) % in.count];
    const double da = sign * (a[axis] - at), db = sign * (b[axis] - at);
    if (da >= 0) out.push(a);
    if ((da >= 0) != (db >= 0)) {
      Vec2d p = a + (b - a) * (da / (da - db));
      p[axis] = at;
      out.push(p);
    }
  }
  return out;
}

struct Piece {
  double area = 0;
  Vec2d moment{0};  // area times middle
};

Piece measured(const Polygon& polygon) {
  Piece piece;
  for (std::size_t i = 2; i < polygon.count; ++i) {
    const Vec2d &a = polygon.corners[0], &b = polygon.corners[i - 1], &c = polygon.corners[i];
    const double area = 0.5 * std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    piece.area += area;
    piece.moment += (a + b + c) * (area / 3);
  }
  return piece;
}

/// From where to where a line of constant y crosses a triangle; empty (low > high) where it does not.
std::pair<double, double> crossing(const std::array<Vec2d, 3>& t, double y) {
  double low = 1e300, high = -1e300;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2d &a = t[i], &b = t[(i + 1) % 3];
    if ((a.y <= y) == (b.y <= y)) continue;
    const double x = a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
    low = std::min(low, x), high = std::max(high, x);
  }
  return {low, high};
}

double doubled_area(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

int whole(double v) { return static_cast<int>(std::floor(v)); }

}  // namespace

std::vector<float> smooth_luminance(const Image& image) {
  constexpr int kBlock = 4;
  if (image.size == 0) return {1};
  const auto blocks = static_cast<std::size_t>((image.size + kBlock - 1) / kBlock);
  const auto block_of = [&](std::size_t i) {
    const auto size = static_cast<std::size_t>(image.size);
    return i / size / kBlock * blocks + i % size / kBlock;
  };
  std::vector<Vec2> sums(blocks * blocks, Vec2(0));  // luminance times alpha, alpha
  const std::size_t texels = image.rgba.size() / 4;
  for (std::size_t i = 0; i < texels; ++i) {
    const std::uint8_t* t = &image.rgba[4 * i];
    sums[block_of(i)] += Vec2(luminance({linear_of_srgb(t[0]), linear_of_srgb(t[1]), linear_of_srgb(t[2])}), 1) *
                         (static_cast<float>(t[3]) / 255);
  }
  std::vector<float> out(texels);
  for (std::size_t i = 0; i < texels; ++i) {
    const Vec2& sum = sums[block_of(i)];
    out[i] = sum.y > 0 ? sum.x / sum.y : 0;
  }
  return out;
}

TexelMeans::TexelMeans(const Image& image) : size_(std::max(image.size, 1)), luminance_(smooth_luminance(image)) {
  std::array<double, 256> linear{};
  for (std::size_t i = 0; i < linear.size(); ++i)
    linear[i] = static_cast<double>(linear_of_srgb(static_cast<std::uint8_t>(i)));
  if (image.size == 0) texels_.push_back(Vec4d(1));
  for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4) {
    const double alpha = image.rgba[i + 3] / 255.0;
    texels_.push_back(
        Vec4d(Vec3d(linear[image.rgba[i]], linear[image.rgba[i + 1]], linear[image.rgba[i + 2]]) * alpha, alpha));
  }
}

std::size_t TexelMeans::place(int x, int y) const {
  const auto repeated = [&](int v) { return static_cast<std::size_t>(((v % size_) + size_) % size_); };
  return repeated(y) * static_cast<std::size_t>(size_) + repeated(x);
}

struct TexelMeans::Sums {
  Vec4d colour{0};
  Vec2d middle{0};
  double square = 0;
  void add(const Vec4d& texel, double luminance, const Piece& piece) {
    colour += texel * piece.area;
    square += luminance * luminance * texel.w * piece.area;
    middle += piece.moment * texel.w;
  }
};

/// Texels that both edges of the row cross whole are whole inside; the others are cut.
void TexelMeans::add_row(const std::array<Vec2d, 3>& t, int row, Sums& sums) const {
  Polygon band;
  for (const Vec2d& p : t) band.push(p);
  band = cut(cut(band, 1, row, 1), 1, row + 1.0, -1);
  if (band.count < 3) return;
  const auto [low, high] =
      std::minmax_element(band.corners.begin(), band.corners.begin() + static_cast<long>(band.count),
                          [](const Vec2d& a, const Vec2d& b) { return a.x < b.x; });
  const auto above = crossing(t, row), below = crossing(t, row + 1.0);
  const double inner_low = std::max(above.first, below.first), inner_high = std::min(above.second, below.second);
  for (int x = whole(low->x), end = whole(high->x); x <= end; ++x) {
    const bool whole_texel = x >= inner_low && x + 1 <= inner_high;
    const std::size_t i = place(x, row);
    sums.add(texels_[i], static_cast<double>(luminance_[i]),
             whole_texel ? Piece{1, {x + 0.5, row + 0.5}} : measured(cut(cut(band, 0, x, 1), 0, x + 1.0, -1)));
  }
}

TexelMean TexelMeans::over(const std::array<Vec2d, 3>& uv) const {
  const double side = size_;
  const std::array<Vec2d, 3> t{uv[0] * side, uv[1] * side, uv[2] * side};
  const double area = doubled_area(t[0], t[1], t[2]);
  Sums sums;
  if (std::abs(area) < 1e-9) {
    const Vec2d at = (t[0] + t[1] + t[2]) / 3.0;
    const std::size_t i = place(whole(at.x), whole(at.y));
    const Vec4d& only = texels_[i];
    const auto light = static_cast<double>(luminance_[i]);
    return {only.w > 0 ? Vec3d(only) / only.w : Vec3d(0), only.w, light * light};
  }
  const auto [low, high] = std::minmax({t[0].y, t[1].y, t[2].y});
  for (int row = whole(low), end = whole(high); row <= end; ++row) add_row(t, row, sums);
  if (sums.colour.w <= 0) return {};
  const Vec2d at = sums.middle / sums.colour.w;
  const double b = std::clamp(doubled_area(t[0], at, t[2]) / area, 0.0, 1.0);
  const double c = std::clamp(doubled_area(t[0], t[1], at) / area, 0.0, 1.0 - b);
  return {Vec3d(sums.colour) / sums.colour.w,
          std::min(2 * sums.colour.w / std::abs(area), 1.0),
          sums.square / sums.colour.w,
          {1 - b - c, b, c}};
}

}  // namespace manzana::foliage

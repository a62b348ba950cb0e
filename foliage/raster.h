#pragma once
/// Small pictures of plants on the CPU, for fitting and as an oracle: pixel centres in triangles, and the holes of
/// leaves by alpha.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "foliage/parallel_view.h"

namespace manzana::foliage {

/// Pixels [first, last) of a row, whose centres lie in a closed triangle or parallelogram, but for a rounding at its
/// edges. v and w: the weights of corners 1 and 2 at the first, and how they change from pixel to pixel.
struct PixelSpan {
  int y, first, last;
  float v, w, dv, dw;
};

/// Bounds of a row's pixels by the edges of what is drawn, each a line of x over y: the largest of those on the left,
/// the smallest of those on the right.
class EdgeBounds {
 public:
  EdgeBounds(float left, float right) : left_{left, left}, right_{right, right} {}

  /// Where weight + along * x + up * y >= 0.
  void add(float weight, float along, float up) {
    if (along == 0) return;
    const float scale = -1 / along;
    if (along > 0)
      left_[lefts_] = weight * scale, left_step_[lefts_++] = up * scale;
    else
      right_[rights_] = weight * scale, right_step_[rights_++] = up * scale;
  }
  float left(float y) const { return std::max(left_[0] + left_step_[0] * y, left_[1] + left_step_[1] * y); }
  float right(float y) const { return std::min(right_[0] + right_step_[0] * y, right_[1] + right_step_[1] * y); }

 private:
  std::array<float, 2> left_, right_, left_step_{}, right_step_{};
  std::size_t lefts_ = 0, rights_ = 0;
};

enum class Form : std::uint8_t { triangle, parallelogram };

/// Of a row of `most` pixels the first whose centre is not below `v`. Without std::ceil, which older processors call.
inline int first_pixel(float v, float most) {
  const float at = std::clamp(v - 0.5F, 0.0F, most);
  const int whole = static_cast<int>(at);
  return whole + (at > static_cast<float>(whole) ? 1 : 0);
}

/// Three corners in pixels, of a parallelogram the first, and those beside it. What is outside the picture is cut off.
template <class Visit>  // void(const PixelSpan&)
void for_each_span(const std::array<Vec2, 3>& t, int pixels, Visit&& visit, Form form = Form::triangle) {
  const Vec2 pa = t[0], pb = t[1] - pa, pc = t[2] - pa;
  const float area = pb.x * pc.y - pb.y * pc.x;
  if (std::abs(area) < 1e-9F) return;
  const float most = static_cast<float>(pixels);
  const auto pixel = [&](float v) { return first_pixel(v, most); };
  const Vec2 pd = form == Form::parallelogram ? pb + pc : pb;
  const Vec2 low = glm::min(glm::min(Vec2(0), pb), glm::min(pc, pd)),
             high = glm::max(glm::max(Vec2(0), pb), glm::max(pc, pd));
  if (pixel(pa.x + low.x) == pixel(pa.x + high.x)) return;
  const int bottom = pixel(pa.y + low.y), top = pixel(pa.y + high.y);
  const Vec2 v = Vec2(pc.y, -pc.x) / area, w = Vec2(-pb.y, pb.x) / area;  // weights of a place relative to corner 0
  EdgeBounds bounds(low.x, high.x);
  bounds.add(0, v.x, v.y);
  bounds.add(0, w.x, w.y);
  if (form == Form::triangle) {
    bounds.add(1, -v.x - w.x, -v.y - w.y);
  } else {
    bounds.add(1, -v.x, -v.y);
    bounds.add(1, -w.x, -w.y);
  }
  for (int y = bottom; y < top; ++y) {
    const float py = static_cast<float>(y) + 0.5F - pa.y;
    const int first = pixel(pa.x + bounds.left(py)), last = pixel(pa.x + bounds.right(py));
    if (first >= last) continue;
    const Vec2 p(static_cast<float>(first) + 0.5F - pa.x, py);
    visit(PixelSpan{y, first, last, glm::dot(v, p), glm::dot(w, p), v.x, w.x});
  }
}

/// Which corners of a quad are corners 1 and 2 of what is drawn of it; corner 0 is its own.
struct QuadPart {
  std::size_t b, c;
};

/// Values of pixels side by side; comparisons give -1 or 0 for each. Compilers do not make vectors of loops over so
/// few.
inline constexpr int kLanes = 4;
template <class T>
using Lanes [[gnu::vector_size(kLanes * sizeof(T))]] = T;

template <class T>
Lanes<T> lanes_at(const T* first) {
  Lanes<T> lanes;
  std::memcpy(&lanes, first, sizeof lanes);
  return lanes;
}

inline bool none(const Lanes<std::int32_t>& lanes) {
  std::array<std::uint64_t, 2> bits;
  std::memcpy(&bits, &lanes, sizeof lanes);
  return (bits[0] | bits[1]) == 0;
}

/// What is linear over a part of a quad, along a span of it: [i] at its pixel i.
class Along {
 public:
  Along(const PixelSpan& span, const std::array<float, 4>& corners, const QuadPart& part) {
    const float a = corners[0], b = corners[part.b] - a, c = corners[part.c] - a;
    value_ = a + b * span.v + c * span.w;
    step_ = b * span.dv + c * span.dw;
  }
  float operator[](int i) const { return value_ + step_ * static_cast<float>(i); }
  /// At pixels i to i + kLanes - 1.
  Lanes<float> lanes(int i) const {
    const Lanes<std::int32_t> pixels = i + Lanes<std::int32_t>{0, 1, 2, 3};
    return value_ + step_ * __builtin_convertvector(pixels, Lanes<float>);
  }

 private:
  float value_, step_;
};

/// Where a leaf's picture is leaf: texels with alpha of one half or more. uv repeat. Without a picture, everywhere.
class LeafHoles {
 public:
  explicit LeafHoles(const Image& image) : size_(std::max(image.size, 1)) {
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) opaque_.push_back(image.rgba[i] >= 128);
    if (opaque_.empty()) opaque_.push_back(1);
  }
  /// From -1 on.
  bool opaque(float u, float v) const { return opaque(texel(v) * size_ + texel(u)); }

  /// For opaque(); rows one after the other.
  Lanes<std::int32_t> texels(const Lanes<float>& u, const Lanes<float>& v) const { return texel(v) * size_ + texel(u); }
  bool opaque(int texel) const { return opaque_[static_cast<std::size_t>(texel)] != 0; }

 private:
  int texel(float at) const {
    const float up = at + 1, part = up - static_cast<float>(static_cast<int>(up));
    return std::min(static_cast<int>(part * static_cast<float>(size_)), size_ - 1);
  }

  Lanes<std::int32_t> texel(const Lanes<float>& at) const {
    const auto whole = [](const Lanes<float>& lanes) { return __builtin_convertvector(lanes, Lanes<std::int32_t>); };
    const Lanes<float> up = at + 1, part = up - __builtin_convertvector(whole(up), Lanes<float>);
    const Lanes<std::int32_t> texels = whole(part * static_cast<float>(size_));
    return texels < size_ ? texels : size_ - 1 + Lanes<std::int32_t>{};
  }

  int size_;
  std::vector<std::uint8_t> opaque_;
};

struct QuadUv {
  explicit QuadUv(const PlantQuad& quad) {
    for (std::size_t c = 0; c < 4; ++c) {
      u[c] = static_cast<float>(quad.corners[c].u) * (kUvRange / 65535);
      v[c] = static_cast<float>(quad.corners[c].v) * (kUvRange / 65535);
    }
  }
  std::array<float, 4> u, v;
};

/// A parallelogram with a picture that fits: most leaves are. To a ten thousandth of its size.
inline Form form_of(const PlantQuad& quad, const QuadUv& uv) {
  const auto& c = quad.corners;
  const Vec3 off = c[0].position - c[1].position + c[2].position - c[3].position,
             across = c[2].position - c[0].position;
  const bool flat = glm::dot(off, off) <= 1e-8F * glm::dot(across, across);
  const bool fits = std::abs(uv.u[0] - uv.u[1] + uv.u[2] - uv.u[3]) < 1e-3F &&
                    std::abs(uv.v[0] - uv.v[1] + uv.v[2] - uv.v[3]) < 1e-3F;
  return flat && fits ? Form::parallelogram : Form::triangle;
}

/// Spans of a quad whose corners are at those pixels: of a parallelogram, or of both its triangles.
template <class Visit>  // void(const PixelSpan&, const QuadPart&)
void for_each_quad_span(const std::array<Vec2, 4>& at, Form form, int pixels, Visit&& visit) {
  const auto draw = [&](const QuadPart& part) {
    const auto each = [&](const PixelSpan& span) { visit(span, part); };
    for_each_span({at[0], at[part.b], at[part.c]}, pixels, each, form);
  };
  if (form == Form::parallelogram) return draw({1, 3});
  draw({1, 2});
  draw({2, 3});
}

}  // namespace manzana::foliage

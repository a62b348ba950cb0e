#include "apps/foliage_benchmark/image_error.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "apps/common/quantile.h"
#include "foliage/leaf_image.h"

namespace manzana::foliage_benchmark {
namespace {

constexpr int kGrownBy = 5;  // pixels

/// One number a pixel.
struct Plane {
  Plane(int columns, int rows)
      : width(columns), height(rows), values(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)) {}
  int width, height;
  std::vector<float> values;

  /// Beyond the border it goes on as it ends.
  const float* row(int y) const {
    return &values[static_cast<std::size_t>(std::clamp(y, 0, height - 1)) * static_cast<std::size_t>(width)];
  }
  float* row(int y) { return const_cast<float*>(std::as_const(*this).row(y)); }
  float at(int x, int y) const { return row(y)[std::clamp(x, 0, width - 1)]; }
};

/// Rows side by side.
template <class F>
Plane make_plane(int width, int height, F&& f) {
  Plane plane(width, height);
  tbb::parallel_for(0, height, [&](int y) {
    float* row = plane.row(y);
    for (int x = 0; x < width; ++x) row[x] = f(x, y);
  });
  return plane;
}

Vec3 srgb_at(const Vec4& texel) {
  const Vec3 light = seen_at(texel);
  return {to_srgb(light.x), to_srgb(light.y), to_srgb(light.z)};
}

/// Before the sky, which most of a picture is.
std::vector<Vec3> srgb_of(const Picture& picture) {
  const Vec3 sky = srgb_at(Vec4(0));
  std::vector<Vec3> all(picture.texels.size());
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t i) {
    const Vec4& texel = picture.texels[i];
    all[i] = texel == Vec4(0) ? sky : srgb_at(texel);
  });
  return all;
}

/// 0 to 255.  [ITU-R BT.709, item 3.3]
Plane luma_of(const std::vector<Vec3>& srgb, int width, int height) {
  Plane plane(width, height);
  std::ranges::transform(srgb, plane.values.begin(), [](const Vec3& c) { return 255 * foliage::luminance(c); });
  return plane;
}

constexpr int kReach = 5;
using Window = std::array<float, 2 * kReach + 1>;

Window gaussian() {
  Window weights{};
  float sum = 0;
  for (int i = -kReach; i <= kReach; ++i)
    sum += weights[static_cast<std::size_t>(i + kReach)] = std::exp(-static_cast<float>(i * i) / 4.5F);
  for (float& w : weights) w /= sum;
  return weights;
}

/// Sums of rows, as compilers make vectors of them: of values beside each other, then above each other.
Plane blurred(const Plane& plane) {
  static const Window weights = gaussian();
  const auto n = static_cast<std::size_t>(plane.width);
  const auto add = [n](float weight, const float* from, float* to) {
    for (std::size_t x = 0; x < n; ++x) to[x] += weight * from[x];
  };
  Plane across(plane.width, plane.height), both = across;
  tbb::parallel_for(0, plane.height, [&](int y) {
    std::vector<float> wide(n + weights.size());
    for (std::size_t x = 0; x < wide.size(); ++x) wide[x] = plane.at(static_cast<int>(x) - kReach, y);
    for (std::size_t i = 0; i < weights.size(); ++i) add(weights[i], &wide[i], across.row(y));
  });
  tbb::parallel_for(0, plane.height, [&](int y) {
    for (std::size_t i = 0; i < weights.size(); ++i)
      add(weights[i], across.row(y + static_cast<int>(i) - kReach), both.row(y));
  });
  return both;
}

Plane product(const Plane& a, const Plane& b) {
  return make_plane(a.width, a.height, [&](int x, int y) { return a.at(x, y) * b.at(x, y); });
}

/// [Wang, Bovik, Sheikh, Simoncelli 2004, equation 13]
Plane ssim_map(const Plane& a, const Plane& b) {
  constexpr float c1 = 0.01F * 255 * 0.01F * 255, c2 = 0.03F * 255 * 0.03F * 255;
  const Plane mean_a = blurred(a), mean_b = blurred(b);
  const Plane aa = blurred(product(a, a)), bb = blurred(product(b, b)), ab = blurred(product(a, b));
  return make_plane(a.width, a.height, [&](int x, int y) {
    const float p = mean_a.at(x, y), q = mean_b.at(x, y);
    const float cross = ab.at(x, y) - p * q, spread = aa.at(x, y) - p * p + bb.at(x, y) - q * q;
    return (2 * p * q + c1) * (2 * cross + c2) / ((p * p + q * q + c1) * (spread + c2));
  });
}

Plane halved(const Plane& plane) {
  return make_plane((plane.width + 1) / 2, (plane.height + 1) / 2, [&](int x, int y) {
    return (plane.at(2 * x, 2 * y) + plane.at(2 * x + 1, 2 * y) + plane.at(2 * x, 2 * y + 1) +
            plane.at(2 * x + 1, 2 * y + 1)) /
           4;
  });
}

/// Prewitt's.
Plane gradient(const Plane& p) {
  return make_plane(p.width, p.height, [&](int x, int y) {
    float dx = 0, dy = 0;
    for (int i = -1; i <= 1; ++i) {
      dx += p.at(x + 1, y + i) - p.at(x - 1, y + i);
      dy += p.at(x + i, y + 1) - p.at(x + i, y - 1);
    }
    return std::hypot(dx, dy) / 3;
  });
}

/// [Xue, Zhang, Mou, Bovik 2014, equation 4]
Plane gradient_similarity(const Plane& a, const Plane& b) {
  constexpr float c = 170;
  const Plane ga = gradient(halved(a)), gb = gradient(halved(b));
  return make_plane(ga.width, ga.height, [&](int x, int y) {
    const float p = ga.at(x, y), q = gb.at(x, y);
    return (2 * p * q + c) / (p * p + q * q + c);
  });
}

struct Moments {
  double mean = 0, deviation = 0;
};

/// Over the judged pixels; `scale`: the plane's pixels are so many wide.
Moments moments(const Plane& plane, const std::vector<bool>& judged, int width, int scale) {
  double n = 0, sum = 0, squares = 0;
  for (std::size_t i = 0; i < judged.size(); ++i) {
    if (!judged[i]) continue;
    const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
    const auto v = static_cast<double>(plane.at(x / scale, y / scale));
    n += 1;
    sum += v;
    squares += v * v;
  }
  if (n == 0) return {1, 0};
  return {sum / n, std::sqrt(std::max(0.0, squares / n - sum / n * (sum / n)))};
}

struct Sums {
  double cover = 0;
  Vec3d light{0};
};

Sums sums_of(const Picture& picture) {
  Sums sums;
  for (const Vec4& texel : picture.texels) {
    sums.cover += static_cast<double>(texel.w);
    sums.light += Vec3d(Vec3(texel));
  }
  return sums;
}

void compare_sums(const Picture& a, const Picture& b, ImageError& error) {
  const Sums of_a = sums_of(a), of_b = sums_of(b);
  if (of_a.cover <= 0) return;
  error.cover = of_b.cover / of_a.cover;
  const Vec3d difference = of_b.light / std::max(of_b.cover, 1e-9) - of_a.light / of_a.cover;
  error.colour = std::sqrt(glm::dot(difference, difference) / 3);
}

void compare_silhouettes(const Picture& a, const Picture& b, ImageError& error) {
  double both = 0, either = 0, differences = 0, cover = 0;
  for (std::size_t i = 0; i < a.texels.size(); ++i) {
    const float p = a.texels[i].w, q = b.texels[i].w;
    both += p >= 0.5F && q >= 0.5F ? 1 : 0;
    either += p >= 0.5F || q >= 0.5F ? 1 : 0;
    differences += static_cast<double>(std::abs(p - q));
    cover += static_cast<double>(p);
  }
  if (either > 0) error.iou = both / either;
  if (cover > 0) error.silhouette = differences / cover;
}

double psnr_of(const std::vector<Vec3>& a, const std::vector<Vec3>& b, const std::vector<bool>& judged) {
  double sum = 0, n = 0;
  for (std::size_t i = 0; i < judged.size(); ++i) {
    if (!judged[i]) continue;
    const Vec3d d = Vec3d(a[i] - b[i]);
    sum += glm::dot(d, d);
    n += 3;
  }
  return sum > 0 ? std::min(99.0, -10 * std::log10(sum / n)) : 99;
}

}  // namespace

std::vector<bool> judged_pixels(const Picture& a, const Picture& b, int grown_by) {
  std::vector<unsigned char> judged(a.texels.size());
  const auto mark = [&](int x, int y, int half) {
    if (y < 0 || y >= a.height) return;
    const auto row = judged.begin() + static_cast<std::ptrdiff_t>(y) * a.width;
    std::fill(row + std::max(x - half, 0), row + std::min(x + half + 1, a.width), 1);
  };
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      if (a.at(x, y).w <= 0 && b.at(x, y).w <= 0) continue;
      for (int j = -grown_by; j <= grown_by; ++j)
        mark(x, y + j, static_cast<int>(std::sqrt(grown_by * grown_by - j * j)));
    }
  return {judged.begin(), judged.end()};
}

ImageError image_error(const Picture& reference, const Picture& candidate) {
  assert(reference.width == candidate.width && reference.height == candidate.height);
  ImageError error;
  compare_sums(reference, candidate, error);
  compare_silhouettes(reference, candidate, error);
  const auto judged = judged_pixels(reference, candidate, kGrownBy);
  const std::vector<Vec3> seen_a = srgb_of(reference), seen_b = srgb_of(candidate);
  const Plane a = luma_of(seen_a, reference.width, reference.height),
              b = luma_of(seen_b, reference.width, reference.height);
  error.ssim = moments(ssim_map(a, b), judged, a.width, 1).mean;
  error.gmsd = moments(gradient_similarity(a, b), judged, a.width, 2).deviation;
  error.psnr = psnr_of(seen_a, seen_b, judged);
  return error;
}

Step step_between(const Picture& before, const Picture& after) {
  const auto judged = judged_pixels(before, after, 0);
  std::vector<double> steps;
  double sum = 0;
  for (std::size_t i = 0; i < judged.size(); ++i) {
    if (!judged[i]) continue;
    const Vec3 d = glm::abs(srgb_at(before.texels[i]) - srgb_at(after.texels[i]));
    const float largest = std::max({d.x, d.y, d.z});
    steps.push_back(static_cast<double>(largest));
    sum += steps.back();
  }
  if (steps.empty()) return {};
  const double mean = sum / static_cast<double>(steps.size());
  const double most = *std::max_element(steps.begin(), steps.end());
  return {mean, apps::quantile(std::move(steps), 0.999), most};
}

}  // namespace manzana::foliage_benchmark

#include "foliage/leaf_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "foliage/random.h"

namespace manzana::foliage {
namespace {

constexpr int kSub = 3;  // samples a texel, along a side
constexpr int kFine = kPlantImageSize * kSub;
constexpr float kPi = 3.14159265F;

Vec3 colour_of(std::uint32_t rgb) {
  return {linear_of_srgb(static_cast<std::uint8_t>(rgb >> 16)), linear_of_srgb(static_cast<std::uint8_t>(rgb >> 8)),
          linear_of_srgb(static_cast<std::uint8_t>(rgb))};
}

struct Texel {
  Vec3 colour{0};
  float alpha = 0;
};

/// The picture while it is drawn: x to the right, y up, both in [0, 1]; linear light.
struct Canvas {
  std::vector<Texel> texels = std::vector<Texel>(static_cast<std::size_t>(kFine) * kFine);

  /// Paints where paint(p, colour) is true, within a box about `middle`. The border stays free, so that clamping and
  /// mipmaps show no edge.
  template <class Paint>
  void fill(Vec2 middle, float reach, Paint&& paint) {
    const auto first = [](float v) { return std::clamp(static_cast<int>(v * kFine), 2 * kSub, kFine - 2 * kSub); };
    for (int y = first(middle.y - reach); y < first(middle.y + reach); ++y) {
      for (int x = first(middle.x - reach); x < first(middle.x + reach); ++x) {
        const Vec2 p((static_cast<float>(x) + 0.5F) / kFine, (static_cast<float>(y) + 0.5F) / kFine);
        Texel& texel = texels[static_cast<std::size_t>(kFine - 1 - y) * kFine + static_cast<std::size_t>(x)];
        if (paint(p, texel.colour)) texel.alpha = 1;
      }
    }
  }
};

/// A leaf's blade in its own axes: s from foot 0 to tip 1, t across, in units of its length.
struct Blade {
  float width;    // widest, over length
  float fullest;  // where along the leaf
};

float half_width(const Blade& blade, float s) {
  if (s <= 0 || s >= 1) return 0;
  const float power = std::log(0.5F) / std::log(blade.fullest);
  return 0.5F * blade.width * std::pow(std::sin(kPi * std::pow(s, power)), 0.75F);
}

void draw_leaf(Canvas& canvas, Vec2 foot, float angle, float length, const Blade& blade, const Vec3& colour) {
  const Vec2 along(std::sin(angle), std::cos(angle)), across(along.y, -along.x);
  canvas.fill(foot + along * (0.5F * length), 0.75F * length, [&](const Vec2& p, Vec3& out) {
    const float s = glm::dot(p - foot, along) / length, t = glm::dot(p - foot, across) / length;
    const float half = half_width(blade, s);
    if (std::abs(t) > half) return false;
    const float rib = std::abs(t) < 0.022F ? 1.25F : 1.0F;
    const float side_ribs = 1 + 0.06F * std::sin(26 * (s - 0.7F * std::abs(t)));
    const float halves = t < 0 ? 0.92F : 1.06F;  // a leaf is folded along its middle
    out = colour * (rib * side_ribs * halves * (0.9F + 0.2F * s));
    return true;
  });
}

void draw_line(Canvas& canvas, Vec2 a, Vec2 b, float width, const Vec3& colour) {
  const Vec2 d = b - a;
  const float length = std::max(glm::length(d), 1e-6F);
  canvas.fill((a + b) * 0.5F, 0.5F * length + width, [&](const Vec2& p, Vec3& out) {
    const float s = std::clamp(glm::dot(p - a, d) / (length * length), 0.0F, 1.0F);
    if (glm::length(p - a - d * s) > 0.5F * width * (1.2F - 0.6F * s)) return false;
    out = colour;
    return true;
  });
}

/// Older leaves lie behind and are darker; a few turn to yellow.
Vec3 varied(const Vec3& colour, float front, Random& random) {
  const float light = 0.62F + 0.5F * front + random.spread(0.13F);
  const float warm = random.spread(0.12F);
  return colour * light * Vec3(1 + warm, 1, 1 - 0.5F * warm);
}

Vec2 heading(float angle) { return {std::sin(angle), std::cos(angle)}; }

const Vec3 kTwig{0.06F, 0.045F, 0.03F};

struct TwigStyle {
  int side_twigs;
  int leaves_each;
  float leaf_length;
  Blade blade;
};

/// A main twig with side twigs on alternate sides, each with leaves all along.
void draw_broadleaf(Canvas& canvas, const TwigStyle& style, const Vec3& colour, Random& random) {
  struct Leaf {
    Vec2 foot;
    float angle;
  };
  std::vector<Leaf> leaves;
  draw_line(canvas, {0.5F, 0.0F}, {0.5F, 0.85F}, 0.014F, kTwig);
  for (int i = 0; i < style.side_twigs; ++i) {
    const float along = (static_cast<float>(i) + 0.5F) / static_cast<float>(style.side_twigs);
    const float side = i % 2 == 0 ? 1.0F : -1.0F;
    const float angle = side * (1.15F - 0.55F * along + random.spread(0.2F));
    const float length = 0.40F * std::sqrt(std::sin(kPi * (0.16F + 0.72F * along)));
    const Vec2 foot(0.5F, 0.06F + 0.72F * along);
    draw_line(canvas, foot, foot + heading(angle) * length, 0.009F, kTwig);
    for (int k = 0; k < style.leaves_each; ++k) {
      const float at = (static_cast<float>(k) + 0.6F + random.spread(0.3F)) / static_cast<float>(style.leaves_each);
      const float turn = (k % 2 == 0 ? 0.75F : -0.75F) + random.spread(0.5F);
      leaves.push_back({foot + heading(angle) * (length * at), angle + (k + 1 == style.leaves_each ? 0 : turn)});
    }
  }
  for (int k = 0; k < 4; ++k) leaves.push_back({{0.5F, 0.66F + 0.05F * static_cast<float>(k)}, random.spread(0.7F)});
  for (std::size_t i = leaves.size(); i > 1; --i) std::swap(leaves[i - 1], leaves[random.bits() % i]);
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const float front = static_cast<float>(i) / static_cast<float>(leaves.size());
    const float length = style.leaf_length * (0.8F + random.spread(0.2F));
    draw_leaf(canvas, leaves[i].foot, leaves[i].angle, length, style.blade, varied(colour, front, random));
  }
}

void draw_needles(Canvas& canvas, Vec2 a, Vec2 b, float length, int count, const Vec3& colour, Random& random) {
  const Vec2 d = b - a;
  const float angle = std::atan2(d.x, d.y);
  for (int i = 0; i < count; ++i) {
    const float at = static_cast<float>(i) / static_cast<float>(count);
    const float turn = (i % 2 == 0 ? 1.0F : -1.0F) * (0.75F + random.spread(0.3F));
    const Vec2 foot = a + d * at;
    const Vec2 tip = foot + heading(angle + turn) * (length * (0.85F + random.spread(0.2F)));
    draw_line(canvas, foot, tip, 0.0115F, varied(colour, 0.3F + 0.6F * at, random));
  }
}

void draw_conifer(Canvas& canvas, const Vec3& colour, Random& random) {
  constexpr int kSides = 16;
  draw_line(canvas, {0.5F, 0.0F}, {0.5F, 0.9F}, 0.016F, kTwig);
  for (int i = 0; i < kSides; ++i) {
    const float along = (static_cast<float>(i) + 0.5F) / kSides;
    const float side = i % 2 == 0 ? 1.0F : -1.0F;
    const float angle = side * (0.95F - 0.25F * along + random.spread(0.12F));
    const float length = 0.44F * (1 - 0.72F * along) * std::min(1.0F, 0.55F + 3 * along);
    const Vec2 foot(0.5F, 0.03F + 0.82F * along), tip = foot + heading(angle) * length;
    draw_line(canvas, foot, tip, 0.010F, kTwig);
    draw_needles(canvas, foot, tip, 0.062F, 16 + static_cast<int>(length * 110), colour, random);
  }
  draw_needles(canvas, {0.5F, 0.0F}, {0.5F, 0.9F}, 0.066F, 90, colour, random);
}

/// Mean over the samples of each texel: colours weighted by alpha.
Image reduced(const Canvas& canvas) {
  Image image{kPlantImageSize, std::vector<std::uint8_t>(std::size_t{4} * kPlantImageSize * kPlantImageSize)};
  for (int y = 0; y < kPlantImageSize; ++y) {
    for (int x = 0; x < kPlantImageSize; ++x) {
      Vec3 sum(0);
      float alpha = 0;
      for (int s = 0; s < kSub * kSub; ++s) {
        const auto at = static_cast<std::size_t>((y * kSub + s / kSub) * kFine + x * kSub + s % kSub);
        sum += canvas.texels[at].colour * canvas.texels[at].alpha;
        alpha += canvas.texels[at].alpha;
      }
      std::uint8_t* texel = &image.rgba[static_cast<std::size_t>(4 * (y * kPlantImageSize + x))];
      if (alpha <= 0) continue;
      for (int c = 0; c < 3; ++c) texel[c] = srgb_of_linear(sum[c] / alpha);
      texel[3] = static_cast<std::uint8_t>(std::lround(255 * alpha / (kSub * kSub)));
    }
  }
  dilate_colour(image);
  return image;
}

/// Value noise that repeats after `period_x` and `period_y` cells; [0, 1].
float noise(float x, float y, int period_x, int period_y, std::uint64_t seed) {
  const auto ix = static_cast<int>(std::floor(x)), iy = static_cast<int>(std::floor(y));
  const auto corner = [&](int dx, int dy) {
    const int cx = (ix + dx) % period_x, cy = (iy + dy) % period_y;
    return Random(hash(seed, static_cast<std::uint64_t>(cy) * 4096 + static_cast<std::uint64_t>(cx))).uniform();
  };
  const auto smooth = [](float f) { return f * f * (3 - 2 * f); };
  const float fx = smooth(x - std::floor(x)), fy = smooth(y - std::floor(y));
  return glm::mix(glm::mix(corner(0, 0), corner(1, 0), fx), glm::mix(corner(0, 1), corner(1, 1), fx), fy);
}

/// Height of the bark in [0, 1]: ridges along y with cracks between them, and a fine grain.
float bark_height(float u, float v, std::uint64_t seed) {
  const float bend = noise(u * 6, v * 4, 6, 4, hash(seed, 9)) - 0.5F;
  float x = u * 14 + 2.2F * bend;
  x -= 14 * std::floor(x / 14);
  const float ridge = 1 - std::abs(2 * noise(x, v * 5, 14, 5, seed) - 1);
  const float cracks = 1 - std::abs(2 * noise(u * 10, v * 12, 10, 12, hash(seed, 3)) - 1);
  const float grain = noise(u * 64, v * 40, 64, 40, hash(seed, 5));
  return std::clamp(0.55F * ridge + 0.25F * cracks + 0.2F * grain, 0.0F, 1.0F);
}

}  // namespace

float linear_of_srgb(std::uint8_t value) {  // IEC 61966-2-1
  const float v = static_cast<float>(value) / 255;
  return v <= 0.04045F ? v / 12.92F : std::pow((v + 0.055F) / 1.055F, 2.4F);
}

std::uint8_t srgb_of_linear(float value) {
  const float v = std::clamp(value, 0.0F, 1.0F);
  const float s = v <= 0.0031308F ? 12.92F * v : 1.055F * std::pow(v, 1 / 2.4F) - 0.055F;
  return static_cast<std::uint8_t>(std::lround(s * 255));
}

void dilate_colour(Image& image) {
  const int n = image.size;
  std::vector<std::uint32_t> queue;  // breadth first from the texels that have a colour
  std::vector<bool> known(static_cast<std::size_t>(n) * static_cast<std::size_t>(n), false);
  for (std::uint32_t i = 0; i < known.size(); ++i) {
    if (image.rgba[4 * std::size_t{i} + 3] == 0) continue;
    known[i] = true;
    queue.push_back(i);
  }
  if (queue.empty()) {
    for (std::size_t i = 0; i < image.rgba.size(); ++i) image.rgba[i] = i % 4 == 3 ? 0 : 128;
    return;
  }
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const int x = static_cast<int>(queue[head]) % n, y = static_cast<int>(queue[head]) / n;
    for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{-1, 0}, std::pair{0, 1}, std::pair{0, -1}}) {
      if (x + dx < 0 || x + dx >= n || y + dy < 0 || y + dy >= n) continue;
      const auto next = static_cast<std::uint32_t>((y + dy) * n + x + dx);
      if (known[next]) continue;
      known[next] = true;
      std::copy_n(&image.rgba[4 * std::size_t{queue[head]}], 3, &image.rgba[4 * std::size_t{next}]);
      queue.push_back(next);
    }
  }
}

Image leaf_image(const std::string& shape, std::uint32_t rgb, std::uint64_t seed) {
  Canvas canvas;
  Random random(seed);
  const Vec3 colour = colour_of(rgb);
  if (shape == "oval")
    draw_broadleaf(canvas, {12, 6, 0.135F, {0.56F, 0.45F}}, colour, random);
  else if (shape == "round")
    draw_broadleaf(canvas, {11, 6, 0.12F, {0.95F, 0.5F}}, colour, random);
  else if (shape == "needle")
    draw_conifer(canvas, colour, random);
  else
    throw std::invalid_argument("leaf_shape \"" + shape + "\" is none of oval, needle, round");
  return reduced(canvas);
}

Image bark_image(std::uint32_t rgb, std::uint64_t seed) {
  const Vec3 colour = colour_of(rgb);
  Image image{kPlantImageSize, std::vector<std::uint8_t>(std::size_t{4} * kPlantImageSize * kPlantImageSize, 255)};
  std::uint8_t* texel = image.rgba.data();
  for (int y = 0; y < kPlantImageSize; ++y) {
    for (int x = 0; x < kPlantImageSize; ++x) {
      const float u = static_cast<float>(x) / kPlantImageSize, v = static_cast<float>(y) / kPlantImageSize;
      const float light = 0.45F + 1.0F * bark_height(u, v, seed);
      for (int c = 0; c < 3; ++c) texel[c] = srgb_of_linear(colour[c] * light);
      texel += 4;
    }
  }
  return image;
}

}  // namespace manzana::foliage

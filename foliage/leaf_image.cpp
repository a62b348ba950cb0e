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

struct Texel {
  Vec3 colour{0};
  float alpha = 0;
};

/// The picture while it is drawn: x to the right, y up, both in [0, 1] over a window of it; linear light.
struct Canvas {
  Vec2 low{0}, high{1};  // the window
  std::vector<Texel> texels = std::vector<Texel>(static_cast<std::size_t>(kFine) * kFine);

  /// Paints where paint(p, colour) is true, within a box about `middle`. The window's border stays free, so that
  /// clamping and mipmaps show no edge.
  template <class Paint>
  void fill(Vec2 middle, float reach, Paint&& paint) {
    const auto first = [&](int axis, float v) {
      const auto at = [&](float w) { return static_cast<int>((low[axis] + w * (high[axis] - low[axis])) * kFine); };
      return std::clamp(at(v), at(0) + 2 * kSub, at(1) - 2 * kSub);
    };
    for (int y = first(1, middle.y - reach); y < first(1, middle.y + reach); ++y) {
      for (int x = first(0, middle.x - reach); x < first(0, middle.x + reach); ++x) {
        const Vec2 at((static_cast<float>(x) + 0.5F) / kFine, (static_cast<float>(y) + 0.5F) / kFine);
        const Vec2 p = (at - low) / (high - low);
        Texel& texel = texels[static_cast<std::size_t>(kFine - 1 - y) * kFine + static_cast<std::size_t>(x)];
        if (paint(p, texel.colour)) texel.alpha = 1;
      }
    }
  }
};

/// A leaf's blade in its own axes: s from foot 0 to tip 1, t across, in units of its length.
struct Blade {
  float width;      // widest, over length
  float fullest;    // where along the leaf
  float lobes = 0;  // on each side
  float depth = 0;  // of the bays between them, over the half width
};

float half_width(const Blade& blade, float s) {
  if (s <= 0 || s >= 1) return 0;
  const float power = std::log(0.5F) / std::log(blade.fullest);
  const float bays = 0.5F * blade.depth * (1 + std::cos(2 * kPi * blade.lobes * s));
  return 0.5F * blade.width * std::pow(std::sin(kPi * std::pow(s, power)), 0.75F) * (1 - bays);
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

/// Long twigs side by side, each with narrow leaves that point along it.
void draw_lances(Canvas& canvas, const Vec3& colour, Random& random) {
  constexpr int kTwigs = 6, kLeaves = 17;
  for (int i = 0; i < kTwigs; ++i) {
    const float lean = (static_cast<float>(i) - 0.5F * (kTwigs - 1)) * 0.11F;
    const float length = 0.92F - 0.5F * std::abs(lean) + random.spread(0.06F);
    const Vec2 foot(0.5F + 0.5F * lean, 0), tip = foot + heading(lean) * length * Vec2(1.4F, 0.95F);
    draw_line(canvas, foot, tip, 0.007F, kTwig);
    for (int k = 1; k <= kLeaves; ++k) {
      const float at = (static_cast<float>(k) + random.spread(0.3F)) / (kLeaves + 0.5F);
      const float turn = (k % 2 == 0 ? 0.5F : -0.5F) + random.spread(0.25F);
      draw_leaf(canvas, glm::mix(foot, tip, at), lean + turn, 0.13F + random.spread(0.02F), {0.21F, 0.42F},
                varied(colour, static_cast<float>(k) / kLeaves, random));
    }
  }
}

/// Bunches of long needles at the ends of side twigs.
void draw_tufts(Canvas& canvas, const Vec3& colour, Random& random) {
  constexpr int kTufts = 13, kNeedles = 60;
  draw_line(canvas, {0.5F, 0.0F}, {0.5F, 0.75F}, 0.018F, kTwig);
  for (int i = 0; i < kTufts; ++i) {
    const float along = static_cast<float>(i) / (kTufts - 1);
    const float angle = i + 1 == kTufts ? 0 : (i % 2 == 0 ? 1.0F : -1.0F) * (1.1F - 0.6F * along);
    const Vec2 foot(0.5F, 0.1F + 0.62F * along), middle = foot + heading(angle) * (0.3F * (1 - 0.6F * along));
    draw_line(canvas, foot, middle, 0.012F, kTwig);
    for (int k = 0; k < kNeedles; ++k) {
      const float turn = angle + random.spread(2.0F);
      const float length = 0.17F * (0.8F + random.spread(0.2F));
      draw_line(canvas, middle - heading(angle) * (0.05F * random.uniform()), middle + heading(turn) * length, 0.0115F,
                varied(colour, 0.2F + 0.7F * random.uniform(), random));
    }
  }
}

/// A piece of a feather leaf: leaflets on both sides of a rib, from edge to edge.
void draw_frond(Canvas& canvas, const Vec3& colour, Random& random) {
  constexpr int kLeaflets = 26;
  for (int i = 0; i < kLeaflets; ++i) {
    const float along = (static_cast<float>(i) + 0.5F) / kLeaflets;
    const float angle = (i % 2 == 0 ? 1.0F : -1.0F) * (0.95F - 0.3F * along + random.spread(0.08F));
    draw_leaf(canvas, {0.5F, 0.78F * along}, angle, 0.5F - 0.14F * along + random.spread(0.03F), {0.13F, 0.35F},
              varied(colour, 0.3F + 0.6F * random.uniform(), random));
  }
  draw_line(canvas, {0.5F, 0.0F}, {0.5F, 0.95F}, 0.016F, linear_of_rgb(0x9a9a58));
}

/// A ball, lighter above.
void draw_fruit(Canvas& canvas, const Vec3& colour) {
  constexpr Vec2 kMiddle(0.5F, 0.46F);
  draw_line(canvas, {0.5F, 0.8F}, {0.53F, 0.97F}, 0.05F, kTwig);
  canvas.fill(kMiddle, 0.44F, [&](const Vec2& p, Vec3& out) {
    const Vec2 d = (p - kMiddle) / 0.42F;
    const float r2 = glm::dot(d, d);
    if (r2 > 1) return false;
    out = colour * (0.55F + 0.6F * std::max(0.0F, std::sqrt(1 - r2) * 0.6F + 0.5F * d.y));
    return true;
  });
}

/// Five petals round a yellow middle.
void draw_flower(Canvas& canvas, const Vec3& colour) {
  constexpr Vec2 kMiddle(0.5F, 0.5F);
  canvas.fill(kMiddle, 0.48F, [&](const Vec2& p, Vec3& out) {
    const Vec2 d = (p - kMiddle) / 0.46F;
    const float r = glm::length(d), petal = std::abs(std::cos(2.5F * std::atan2(d.x, d.y)));
    if (r > 0.35F + 0.65F * petal) return false;
    out = r < 0.22F ? linear_of_rgb(0xd8b23a) : colour * (0.8F + 0.25F * r);
    return true;
  });
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

}  // namespace

Image leaf_image(const std::string& shape, std::uint32_t rgb, std::uint64_t seed,
                 const std::optional<OrganLook>& organ) {
  Canvas canvas;
  Random random(seed);
  if (organ) canvas.low.y = kOrganSide;
  const Vec3 colour = linear_of_rgb(rgb);
  if (shape == "oval")
    draw_broadleaf(canvas, {12, 6, 0.135F, {0.56F, 0.45F}}, colour, random);
  else if (shape == "round")
    draw_broadleaf(canvas, {11, 6, 0.12F, {0.95F, 0.5F}}, colour, random);
  else if (shape == "lobed")
    draw_broadleaf(canvas, {11, 5, 0.2F, {0.74F, 0.58F, 4, 0.4F}}, colour, random);
  else if (shape == "heart")
    draw_broadleaf(canvas, {9, 5, 0.15F, {0.92F, 0.33F}}, colour, random);
  else if (shape == "lance")
    draw_lances(canvas, colour, random);
  else if (shape == "needle")
    draw_conifer(canvas, colour, random);
  else if (shape == "tuft")
    draw_tufts(canvas, colour, random);
  else if (shape == "frond")
    draw_frond(canvas, colour, random);
  else
    throw std::invalid_argument("leaf_shape \"" + shape +
                                "\" is none of oval, round, lobed, heart, lance, needle, tuft, frond");
  if (organ) {
    canvas.low = Vec2(0), canvas.high = Vec2(kOrganSide);
    organ->organ == Organ::flower ? draw_flower(canvas, linear_of_rgb(organ->rgb))
                                  : draw_fruit(canvas, linear_of_rgb(organ->rgb));
  }
  return reduced(canvas);
}

}  // namespace manzana::foliage

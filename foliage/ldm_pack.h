#pragma once
/// A tree as layered depth mosaics, for far trees.  [Zhang 2004, LDM-Pack]
///   const LdmPack pack = make_ldm_pack(ldm_ball(plant), {}, LdmSampler(plant));  // foliage/make_ldm.h, ldm_sampler.h
///   choose_ldm(...);                                                   // foliage/ldm_select.h, each frame
/// Seen from each of some directions, by parallel rays, the plant's ball is cut across into slabs; each slab is a
/// picture of what it holds, hidden by other slabs or not. A mosaic is a rectangle of such a picture, put at the mean
/// depth of what it shows. Pictures are kept in blocks of 32 x 32, each as coarse as may be, side by side in pages.
#include <array>
#include <cstdint>
#include <vector>

#include "foliage/parallel_view.h"
#include "foliage/plant.h"

namespace manzana::foliage {

/// The source's pages have 512 texels a side; the last one is half empty, which took a broadleaf of 19 000 triangles
/// from 7.0 to 8.4 MB, and to 7.3 MB with 256.
inline constexpr int kLdmPixels = 256, kLdmBlock = 32, kLdmPage = 256, kLdmShrinks = 5;  // 32 = 1 << 5

/// Of a page's levels before that one.
constexpr std::size_t ldm_texels_to(int level) {
  std::size_t sum = 0;
  for (int before = 0; before < level; ++before) sum += std::size_t{kLdmPage} * kLdmPage >> 2 * before;
  return sum;
}

/// Which sides a plant is seen from.
enum class LdmSides : std::uint8_t {
  paper,      ///< 15 directions over the upper half of the sphere; mosaics lie as they were seen
  octahedral  ///< the 18 different vertices of an octahedral grid of 5 x 5 over all of it (foliage/octahedral.h);
              ///< mosaics turn to the eye about their middles, so that a crown covers as much between two sides
};

struct LdmOptions {
  LdmSides sides = LdmSides::octahedral;
  int layers = 6;
  int smallest = 16;         ///< pixels a side of the smallest mosaic; the source does not say
  float colour_delta = 10;   ///< of 255: delta_c
  float disparity_px = 6;    ///< eta_d
  float occlusion = 2;       ///< s: how much more may be wrong of what is hidden; 0: of nothing
  double focal_px = 935;     ///< of the screen that eta_d is meant for: 1080 rows, 60 degrees
  double nearest_radii = 2;  ///< distance of the nearest preset viewpoint, in radii: 1 / sin(60 degrees / 2)
  int nearest = 0;           ///< level; finer ones, and their pictures, are not made
};

/// Levels of detail, each for twice the distance of the one before. The source has the first four, all of the same
/// pictures, so that no tree is less than some 200 mosaics; the others have pictures of their own.
inline constexpr int kLdmLevels = 7;

/// What pictures levels [first, last) are made of.
struct LdmPictures {
  int first, last;
  int pixel;   ///< in finest pixels
  int layers;  ///< at most, of as many as divide those of the options
};
inline constexpr std::array<LdmPictures, 4> kLdmPictures{{{0, 4, 1, 64}, {4, 5, 4, 6}, {5, 6, 8, 3}, {6, 7, 8, 1}}};

inline int level_count(const LdmOptions& options) { return options.sides == LdmSides::paper ? 4 : kLdmLevels; }

/// What is seen at a pixel, 8 bytes.
struct LdmTexel {
  std::array<std::uint8_t, 4> colour{};         ///< sRGB, straight alpha: the share of the pixel that is covered
  std::uint8_t normal_x = 128, normal_y = 128;  ///< octahedral, of the plant's frame: pack_ldm_normal
  std::uint8_t depth = 0;                       ///< from the slab's front, 0, to its back, 255
  std::uint8_t shade = 0;                       ///< ambient light in 127ths; 128 more: a leaf
};
static_assert(sizeof(LdmTexel) == 8);

/// One side's slabs, the nearest first; rows from the bottom.  [Zhang 2004: LDI-Pack]
struct LdmImage {
  explicit LdmImage(int layer_count, int side = kLdmPixels)
      : layers(layer_count), pixels(side), texels(index(layer_count, 0, 0)) {}
  std::size_t index(int layer, int x, int y) const {
    return static_cast<std::size_t>((layer * pixels + y) * pixels + x);
  }
  LdmTexel& at(int layer, int x, int y) { return texels[index(layer, x, y)]; }
  const LdmTexel& at(int layer, int x, int y) const { return texels[index(layer, x, y)]; }

  int layers, pixels;
  std::vector<LdmTexel> texels;
};

/// A square of a slab's picture that is not empty, as a square of a page. 8 bytes.
struct LdmBlock {
  std::uint8_t x = 0, y = 0;  ///< texels of the page, whole multiples of its side
  std::uint8_t page = 0;
  std::uint8_t shrink = 0;  ///< its side is 32 >> shrink texels
  std::uint8_t column = 0, row = 0;
  std::uint8_t pixel = 1;  ///< of the picture, in finest pixels
  std::uint8_t spare = 0;
};
static_assert(sizeof(LdmBlock) == 8);

/// 8 bytes.
struct LdmMosaic {
  std::uint16_t block = 0;  ///< of LdmPack::blocks
  std::uint16_t depth = 0;  ///< of the ball's diameter, from its nearest place, 0, to its farthest, 65535
  std::uint8_t left = 0, low = 0, right = 0, high = 0;  ///< pixels of the block, half-open
};
static_assert(sizeof(LdmMosaic) == 8);

struct LdmSide {
  Vec3 towards, right, up;                ///< orthonormal, of the plant's frame
  std::array<Run, kLdmLevels> mosaics{};  ///< of LdmPack::mosaics, for the nearest distances first; farthest first
};

struct LdmPack {
  LdmOptions options;
  Vec3 centre{0};
  float radius = 1;    ///< of the ball, m
  float height_m = 0;  ///< of the plant, by which wind moves it; 0: it stands still
  /// By how much a level's mosaics grow, times 1 - cosine, as they turn to the eye: so that it covers as much as the
  /// plant (foliage/ldm_cover.h).
  std::array<float, kLdmLevels> grown{};
  std::vector<LdmSide> sides;
  std::vector<LdmBlock> blocks;
  std::vector<LdmMosaic> mosaics;
  std::vector<std::uint8_t> colour, surface;  ///< LdmTexel's halves, 4 bytes a texel: pages of 256 x 256, then the same
                                              ///< of 128 x 128, ... 8 x 8, each texel the mean of four

  std::size_t pages() const { return colour.size() / (4 * ldm_texels_to(1 + kLdmShrinks)); }
  std::size_t level_begin(int level) const { return 4 * pages() * ldm_texels_to(level); }  ///< of colour and surface
  std::size_t mosaic_bytes() const { return mosaics.size() * sizeof(LdmMosaic) + blocks.size() * sizeof(LdmBlock); }
  double distance_of(int level) const { return static_cast<double>(radius) * options.nearest_radii * (1 << level); }
};

/// Throws std::invalid_argument, naming the row, for what would be drawn from outside its list, page or block, and for
/// numbers that are not finite. Linear.
void check(const LdmPack& pack);

/// Of so many texels of 4 bytes, and of all their mip levels.
constexpr double ldm_bytes(double texels) { return texels * 4 * 4 / 3; }

}  // namespace manzana::foliage

#include "foliage/make_ldm.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "foliage/ldm_cover.h"
#include "foliage/ldm_mosaics.h"
#include "foliage/ldm_pages.h"
#include "foliage/ldm_texture.h"
#include "foliage/ldm_views.h"

namespace manzana::foliage {
namespace {

/// Of each pixel the share that nearer slabs hide, layer by layer.
std::vector<std::vector<float>> hidden_in(const LdmImage& image) {
  std::vector<std::vector<float>> hidden;
  std::vector<float> open(image.index(1, 0, 0), 1.0F);
  for (int layer = 0; layer < image.layers; ++layer) {
    std::vector<float>& here = hidden.emplace_back(open.size());
    for (std::size_t i = 0; i < open.size(); ++i) {
      here[i] = 1 - open[i];
      open[i] *= 1 - static_cast<float>(image.texels[image.index(layer, 0, 0) + i].colour[3]) / 255;
    }
  }
  return hidden;
}

LdmSquare block_of(const LdmPlace& place) {
  LdmSquare square{kLdmBlock, {}};
  square.texels.reserve(kLdmBlock * kLdmBlock);
  for (int y = 0; y < kLdmBlock; ++y)
    for (int x = 0; x < kLdmBlock; ++x)
      square.texels.push_back(place.image.at(place.layer, place.column * kLdmBlock + x, place.row * kLdmBlock + y));
  return square;
}

/// A block that is not empty.
struct MadeBlock {
  int layer = 0, column = 0, row = 0, shrink = 0, pixel = 1;
  double adaptive = 0;  // texels that it would have with s = 0
  LdmSquare texels;
  std::array<std::vector<LdmMosaic>, kLdmLevels> mosaics;
};

class Maker {
 public:
  Maker(const Ball& ball, const LdmOptions& options) : ball_(ball) {
    pack_.options = options;
    pack_.centre = ball.centre;
    pack_.radius = ball.radius;
  }

  void add_side(const Vec3d& towards, const SampleLdm& sample) {
    const ParallelView view(towards, ball_.centre, ball_.radius, kLdmPixels);
    const LdmImage image = sample(view, pack_.options.layers);
    LdmSide& side = pack_.sides.emplace_back(LdmSide{view.towards(), view.right(), view.up(), {}});
    for (LdmPictures pictures : kLdmPictures) {
      pictures.first = std::max(pictures.first, pack_.options.nearest);
      if (pictures.first >= std::min(pictures.last, level_count(pack_.options))) continue;
      const bool finest = pictures.pixel == 1;
      add_pictures(finest ? image : coarser(image, pictures.pixel, merged_layers(pictures)), pictures, side);
    }
  }

  LdmPack finish(const SampleLdm& sample, LdmTally* tally) {
    fill_pages();
    if (pack_.options.sides != LdmSides::paper) fit_grown(pack_, seen_from(sample));
    if (tally != nullptr) *tally = tally_;
    check(pack_);
    return std::move(pack_);
  }

 private:
  int merged_layers(const LdmPictures& pictures) const {
    const int layers = pack_.options.layers;
    int merged = 1;
    while (layers % merged != 0 || layers / merged > pictures.layers) ++merged;
    return merged;
  }

  std::vector<LdmSeenFrom> seen_from(const SampleLdm& sample) const {
    std::vector<LdmSeenFrom> seen;
    for (const Vec3d& to_eye : ldm_fitting_directions()) {
      const LdmImage image = sample({to_eye, ball_.centre, ball_.radius, kLdmPixels}, 1);
      double sum = 0;
      for (const LdmTexel& texel : image.texels) sum += texel.colour[3];
      seen.push_back({to_eye, sum / (255.0 * static_cast<double>(image.texels.size()))});
    }
    return seen;
  }

  void add_pictures(const LdmImage& image, const LdmPictures& pictures, LdmSide& side) {
    tally_.raw += static_cast<double>(image.texels.size());
    std::vector<MadeBlock> blocks = blocks_of(image, pictures);
    const std::size_t first = pack_.blocks.size();
    if (first + blocks.size() > 65536) throw std::invalid_argument("a pack has too many blocks");
    for (MadeBlock& block : blocks) keep(block);
    for (int level = pictures.first; level < pictures.last; ++level) add_mosaics(blocks, first, level, side);
  }

  /// From the farthest layer to the nearest.
  std::vector<MadeBlock> blocks_of(const LdmImage& image, const LdmPictures& pictures) const {
    const auto hidden = hidden_in(image);
    const int columns = image.pixels / kLdmBlock;
    const auto of_layer = static_cast<std::size_t>(columns * columns);
    std::vector<std::optional<MadeBlock>> made(static_cast<std::size_t>(image.layers) * of_layer);
    tbb::parallel_for(std::size_t{0}, made.size(), [&](std::size_t i) {
      const int layer = image.layers - 1 - static_cast<int>(i / of_layer), at = static_cast<int>(i % of_layer);
      made[i] =
          make_block({image, layer, at % columns, at / columns, hidden[static_cast<std::size_t>(layer)]}, pictures);
    });
    std::vector<MadeBlock> blocks;
    for (auto& block : made)
      if (block) blocks.push_back(std::move(*block));
    return blocks;
  }

  std::optional<MadeBlock> make_block(const LdmPlace& place, const LdmPictures& pictures) const {
    LdmOptions options = pack_.options;
    if (pictures.pixel > 1) options.smallest = kLdmBlock;  // as few as there are blocks
    const LdmStretch all = stretch_of(place, 0, 0, kLdmBlock);
    if (all.visible == 0) return std::nullopt;
    MadeBlock block{place.layer, place.column, place.row, 0, pictures.pixel, 0, {}, {}};
    auto pyramid = ldm_pyramid(block_of(place));
    const int adaptive = coarsest_level(pyramid, allowed_delta(0, options));
    block.adaptive = static_cast<double>(pyramid[static_cast<std::size_t>(adaptive)].texels.size());
    block.shrink = coarsest_level(pyramid, allowed_delta(all.hidden, options));
    block.texels = std::move(pyramid[static_cast<std::size_t>(block.shrink)]);
    for (int level = pictures.first; level < pictures.last; ++level)
      block.mosaics[static_cast<std::size_t>(level)] =
          split_block(place, options, static_cast<double>(ball_.radius), pack_.distance_of(level));
    return block;
  }

  void keep(MadeBlock& block) {
    const auto byte = [](int v) { return static_cast<std::uint8_t>(v); };
    pack_.blocks.push_back({0, 0, 0, byte(block.shrink), byte(block.column), byte(block.row), byte(block.pixel), 0});
    tally_.adaptive += block.adaptive;
    tally_.aware += static_cast<double>(block.texels.texels.size());
    squares_.push_back(std::move(block.texels));
  }

  void add_mosaics(const std::vector<MadeBlock>& blocks, std::size_t first, int level, LdmSide& side) {
    const auto at = static_cast<std::size_t>(level);
    const auto begin = static_cast<std::uint32_t>(pack_.mosaics.size());
    for (std::size_t i = 0; i < blocks.size(); ++i)
      for (LdmMosaic mosaic : blocks[i].mosaics[at]) {
        mosaic.block = static_cast<std::uint16_t>(first + i);
        pack_.mosaics.push_back(mosaic);
      }
    std::stable_sort(pack_.mosaics.begin() + begin, pack_.mosaics.end(),
                     [](const LdmMosaic& a, const LdmMosaic& b) { return a.depth > b.depth; });
    side.mosaics[at] = {begin, static_cast<std::uint32_t>(pack_.mosaics.size())};
    tally_.mosaics[at] += side.mosaics[at].size();
  }

  void fill_pages() {
    std::vector<int> sides;
    for (const LdmSquare& square : squares_) sides.push_back(square.side);
    const auto places = pack_pages(sides, kLdmPage);
    std::uint32_t pages = 0;
    for (const PagePlace& place : places) pages = std::max(pages, place.page + 1);
    if (pages > 256) throw std::invalid_argument("a pack has too many pages");
    pack_.colour.assign(4 * pages * ldm_texels_to(1 + kLdmShrinks), 0);
    pack_.surface.assign(pack_.colour.size(), 0);
    for (std::size_t i = 0; i < squares_.size(); ++i) fill(squares_[i], places[i], pack_.blocks[i]);
    for (int level = 1; level <= kLdmShrinks; ++level)
      for (std::size_t page = 0; page < pages; ++page) put(halved(page_of(level - 1, page)), level, page);
  }

  std::size_t page_begin(int level, std::size_t page) const {
    return pack_.level_begin(level) + 4 * page * (std::size_t{kLdmPage} * kLdmPage >> 2 * level);
  }

  LdmSquare page_of(int level, std::size_t page) const {
    LdmSquare square{kLdmPage >> level, {}};
    const std::size_t begin = page_begin(level, page), end = page_begin(level, page + 1);
    for (std::size_t i = begin; i < end; i += 4) {
      const std::uint8_t *c = &pack_.colour[i], *s = &pack_.surface[i];
      square.texels.push_back({{c[0], c[1], c[2], c[3]}, s[0], s[1], s[2], s[3]});
    }
    return square;
  }

  void put(const LdmSquare& square, int level, std::size_t page) {
    std::size_t at = page_begin(level, page);
    for (const LdmTexel& texel : square.texels) put(texel, std::exchange(at, at + 4));
  }

  void put(const LdmTexel& texel, std::size_t at) {
    std::copy_n(texel.colour.begin(), 4, &pack_.colour[at]);
    const std::array surface{texel.normal_x, texel.normal_y, texel.depth, texel.shade};
    std::copy_n(surface.begin(), 4, &pack_.surface[at]);
  }

  void fill(const LdmSquare& square, const PagePlace& place, LdmBlock& block) {
    block.x = static_cast<std::uint8_t>(place.x), block.y = static_cast<std::uint8_t>(place.y);
    block.page = static_cast<std::uint8_t>(place.page);
    for (int y = 0; y < square.side; ++y)
      for (int x = 0; x < square.side; ++x) {
        const std::size_t row = std::size_t{place.page} * kLdmPage + place.y + static_cast<std::size_t>(y);
        put(square.at(x, y), 4 * (row * kLdmPage + place.x + static_cast<std::size_t>(x)));
      }
  }

  Ball ball_;
  LdmPack pack_;
  LdmTally tally_;
  std::vector<LdmSquare> squares_;
};

void check_options(const LdmOptions& o) {
  const bool sane = o.layers >= 1 && o.layers <= 64 && o.smallest >= 1 && o.smallest <= kLdmBlock &&
                    o.colour_delta >= 0 && o.disparity_px > 0 && o.occlusion >= 0 && std::isfinite(o.occlusion) &&
                    o.focal_px > 0 && o.focal_px < 1e6 && o.nearest_radii > 1 && o.nearest_radii < 1e6 &&
                    o.nearest >= 0 && o.nearest < level_count(o);
  if (!sane) throw std::invalid_argument("options of a pack are out of range");
}

}  // namespace

Ball ldm_ball(const PreparedPlant& plant) {
  Vec3 low(3e38F), high(-3e38F);
  const auto visit = [&](auto&& each) {
    const Run bark = finest_bark(plant);
    for (std::uint32_t i = bark.first; i < bark.last; ++i)
      for (const PlantQuad::Corner& c : plant.bark[i].corners) each(c.position);
    for (const PlantQuad& quad : plant.leaves)
      for (const PlantQuad::Corner& c : quad.corners) each(c.position);
  };
  visit([&](const Vec3& p) { low = glm::min(low, p), high = glm::max(high, p); });
  if (low.x > high.x) return {};
  Ball ball{0.5F * (low + high), 0};
  visit([&](const Vec3& p) { ball.radius = std::max(ball.radius, glm::distance(p, ball.centre)); });
  ball.radius = std::max(1.001F * ball.radius, 1e-6F);
  return ball;
}

LdmPack make_ldm_pack(const Ball& ball, const LdmOptions& options, const SampleLdm& sample, const Progress& progress,
                      LdmTally* tally) {
  check_options(options);
  Maker maker(ball, options);
  const auto directions = ldm_directions(options.sides);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    maker.add_side(directions[i], sample);
    tell(progress, i + 1, directions.size());
  }
  return maker.finish(sample, tally);
}

}  // namespace manzana::foliage

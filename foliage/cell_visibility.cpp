#include "foliage/cell_visibility.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "foliage/octahedral.h"
#include "foliage/raster.h"

namespace manzana::foliage {
namespace {

constexpr std::uint32_t kNobody = ~0U;

/// A picture of who is nearest, and who came last to each pixel.
class IdPicture {
 public:
  IdPicture(const Image& leaf, const ParallelView& view)
      : holes_(leaf),
        view_(view),
        texels_(static_cast<std::size_t>(view.pixels()) * static_cast<std::size_t>(view.pixels())) {}

  /// Returns how many pixels this quad is the first of its cell to touch; a cell's quads come together.
  std::uint32_t draw(const PlantQuad& quad, std::uint32_t id, bool leaf) {
    std::uint32_t fresh = 0;
    for (const std::size_t k : {1U, 2U}) {
      const std::array<std::size_t, 3> corners{0, k, k + 1};
      std::array<Vec2, 3> at, uv;
      std::array<float, 3> near;
      for (std::size_t c = 0; c < 3; ++c) {
        const PlantQuad::Corner& corner = quad.corners[corners[c]];
        at[c] = view_.pixel(corner.position);
        near[c] = view_.nearness(corner.position);
        uv[c] = Vec2(corner.u, corner.v) * (kUvRange / 65535);
      }
      for_each_pixel(at, view_.pixels(), [&](int x, int y, float v, float w) {
        if (leaf && !holes_.opaque(uv[0] + (uv[1] - uv[0]) * v + (uv[2] - uv[0]) * w)) return;
        fresh += touch(x, y, near[0] + (near[1] - near[0]) * v + (near[2] - near[0]) * w, id);
      });
    }
    return fresh;
  }

  std::vector<std::uint32_t> histogram(std::size_t ids) const {
    std::vector<std::uint32_t> count(ids, 0);
    for (const Texel& texel : texels_)
      if (texel.nearest < ids) ++count[texel.nearest];
    return count;
  }

 private:
  struct Texel {
    float near = -std::numeric_limits<float>::infinity();
    std::uint32_t nearest = kNobody, last = kNobody;
  };

  std::uint32_t touch(int x, int y, float near, std::uint32_t id) {
    Texel& texel =
        texels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(view_.pixels()) + static_cast<std::size_t>(x)];
    if (near >= texel.near) texel.near = near, texel.nearest = id;  // as GL_LEQUAL has it
    const std::uint32_t fresh = texel.last == id ? 0 : 1;
    texel.last = id;
    return fresh;
  }

  LeafHoles holes_;
  const ParallelView& view_;
  std::vector<Texel> texels_;
};

/// Of a vertex of the grid the first one with its direction.
std::uint32_t first_of_pair(std::uint32_t side, std::uint32_t i, std::uint32_t j) {
  if (j == 0 || j == side - 1) i = std::min(i, side - 1 - i);
  if (i == 0 || i == side - 1) j = std::min(j, side - 1 - j);
  return j * side + i;
}

int enough_pixels(const PreparedPlant& plant) {
  const double side = std::sqrt(1000 * static_cast<double>(plant.cells.size()) / 0.5);  // half the picture is crown
  return static_cast<int>(std::clamp(side, 256.0, 1024.0));
}

void bake_direction(PreparedPlant& plant, std::uint32_t vertex, int pixels) {
  const std::uint32_t side = plant.visibility.side;
  const CellPixels count = cell_pixels(plant, grid_direction(side, vertex % side, vertex / side), pixels);
  for (std::size_t c = 0; c < plant.cells.size(); ++c)
    plant.visibility.share[c * side * side + vertex] =
        seen_share(count.seen[c], count.own[c], plant.cells[c].quads.size() == 0);
}

}  // namespace

std::uint8_t seen_share(std::uint32_t seen, std::uint32_t own, bool empty) {
  if (own == 0) return empty ? 0 : 255;
  if (seen == 0) return 0;
  const std::uint64_t rounded = (2 * 255 * std::uint64_t{std::min(seen, own)} + own) / (2 * std::uint64_t{own});
  return static_cast<std::uint8_t>(std::max<std::uint64_t>(rounded, 1));
}

CellPixels cell_pixels(const PreparedPlant& plant, const Vec3d& to_eye, int pixels) {
  const ParallelView view = view_of(plant, to_eye, pixels);
  IdPicture picture(plant.leaf_image, view);
  const Run bark = finest_bark(plant);
  const auto bark_id = static_cast<std::uint32_t>(plant.cells.size());
  for (std::uint32_t q = bark.first; q < bark.last; ++q) picture.draw(plant.bark[q], bark_id, false);
  CellPixels count;
  for (std::uint32_t c = 0; c < plant.cells.size(); ++c) {
    std::uint32_t own = 0;
    for (std::uint32_t q = plant.cells[c].quads.first; q < plant.cells[c].quads.last; ++q)
      own += picture.draw(plant.leaves[q], c, true);
    count.own.push_back(own);
  }
  count.seen = picture.histogram(plant.cells.size());
  return count;
}

void bake_visibility(PreparedPlant& plant, const VisibilityOptions& options) {
  if (options.side < 2 || options.side > 257)
    throw std::invalid_argument("a grid of directions has a side of 2 to 257");
  if (options.pixels < 0 || options.pixels > 8192)
    throw std::invalid_argument("a picture has at most 8192 pixels a side");
  const std::uint32_t side = options.side, all = side * side;
  plant.visibility.side = side;
  plant.visibility.share.assign(plant.cells.size() * all, 0);
  const int pixels = options.pixels > 0 ? options.pixels : enough_pixels(plant);
  tbb::parallel_for(0U, all, [&](std::uint32_t vertex) {
    if (first_of_pair(side, vertex % side, vertex / side) == vertex) bake_direction(plant, vertex, pixels);
  });
  for (std::size_t c = 0; c < plant.cells.size(); ++c)
    for (std::uint32_t vertex = 0; vertex < all; ++vertex)
      plant.visibility.share[c * all + vertex] =
          plant.visibility.share[c * all + first_of_pair(side, vertex % side, vertex / side)];
}

}  // namespace manzana::foliage

#include "scenegraph/ground_photo.h"

#include <tbb/parallel_for.h>

#include "foliage/leaf_image.h"

namespace manzana {
namespace {

using Level = GroundPhoto::Level;
using Texel = GroundPhoto::Texel;

Texel mean(const std::array<Texel, 4>& four) {
  Texel out;
  for (std::size_t c = 0; c < 3; ++c) {
    float sum = 0;
    for (const Texel& t : four) sum += foliage::linear_of_srgb(t[c]);
    out[c] = foliage::srgb_of_linear(sum / 4);
  }
  out[3] = static_cast<std::uint8_t>((four[0][3] + four[1][3] + four[2][3] + four[3][3] + 2) / 4);
  return out;
}

Level halved(const Level& from) {
  Level to{(from.columns + 1) / 2, (from.rows + 1) / 2, {}};
  to.texels.resize(std::size_t{to.columns} * to.rows);
  const auto at = [&](std::uint32_t c, std::uint32_t r) {
    return c < from.columns && r < from.rows ? from.texels[std::size_t{r} * from.columns + c] : Texel{};
  };
  tbb::parallel_for(0U, to.rows, [&](std::uint32_t r) {
    for (std::uint32_t c = 0; c < to.columns; ++c)
      to.texels[std::size_t{r} * to.columns + c] =
          mean({at(2 * c, 2 * r), at(2 * c + 1, 2 * r), at(2 * c, 2 * r + 1), at(2 * c + 1, 2 * r + 1)});
  });
  return to;
}

}  // namespace

void add_levels(std::vector<Level>& levels) {
  while (levels.back().columns > 1 || levels.back().rows > 1) levels.push_back(halved(levels.back()));
}

std::size_t bytes_of(const GroundPhoto& photo) {
  std::size_t sum = 0;
  for (const Level& level : photo.levels) sum += level.texels.size() * sizeof(Texel);
  return sum;
}

}  // namespace manzana

#include "scenegraph/pictures.h"

#include <algorithm>
#include <iterator>

namespace manzana {

std::uint32_t side_of(const EncodedPicture& picture) {
  const std::uint64_t texels = std::uint64_t{picture.worn.width} * picture.worn.height;
  std::uint32_t side = 1;
  while (side < kLargestSquare && std::uint64_t{side} * side < texels) side *= 2;
  return side;
}

std::uint32_t join(Pictures& into, Pictures more) {
  const auto pictures = static_cast<std::uint32_t>(into.encoded.size()),
             textures = static_cast<std::uint32_t>(into.textures.size());
  for (Texture& texture : more.textures) texture.picture += pictures;
  std::ranges::move(more.encoded, std::back_inserter(into.encoded));
  std::ranges::copy(more.textures, std::back_inserter(into.textures));
  return textures;
}

}  // namespace manzana

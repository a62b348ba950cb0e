#pragma once
/// From a scene's picture to what draws: read, decoded, stretched to a square, with its levels. On any thread.
///   if (auto square = picture_square(scene.pictures.encoded[i], 256)) renderer.add_picture(i, *square);
#include <optional>
#include <vector>

#include "scenegraph/pictures.h"

namespace manzana {

/// Its bytes as they are in its file, or in the file of the baked city. Throws std::runtime_error for what is absent,
/// too large, or outside its folder.
std::vector<unsigned char> bytes_of(const EncodedPicture& picture);

/// `side`: a power of two, at most kLargestSquare. None: it cannot be read any more. Each texel is the mean of what it
/// covers, in linear light, weighted by alpha. Linear in the picture's pixels.
std::optional<PictureSquare> picture_square(const EncodedPicture& picture, std::uint32_t side);

}  // namespace manzana

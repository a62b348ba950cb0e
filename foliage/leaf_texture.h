#pragma once
/// Plant images as mip levels whose leaves stay as dense as they were. Plain averaging of alpha makes a far crown thin
/// out under the alpha test; so each level's alpha is scaled until as many texels pass as in the finest. The smallest
/// levels, seen where leaves are smaller than pixels, are not tested: their mean alpha is that share.
/// [Castano 2010, "Computing Alpha Mipmaps"]
#include <vector>

#include "foliage/image.h"

namespace manzana::foliage {

/// Share of texels whose alpha passes the test at one half.
double alpha_coverage(const Image& image);

/// image, half of it, ... 1 x 1. Colours are averaged in linear light, by their alpha. An empty image gives one white
/// texel.
std::vector<Image> coverage_mipmaps(const Image& image);

/// Nearest texels, to another size; what is of that size already is only copied. Empty: white.
Image resized(const Image& image, int size);

}  // namespace manzana::foliage

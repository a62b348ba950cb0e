#pragma once
/// Colours for what no leaf shows of its picture. Pictures are averaged from level to level, so what lies beside a
/// modelled leaf, in a picture without alpha, would tint it where it is seen from afar.
#include <span>

#include "foliage/prepared_plant.h"

namespace manzana::foliage {

/// Texels that no quad's uv touch get the mean colour of those round them that are touched, weighted by alpha; alpha
/// stays. Pictures that repeat are left as they are. Cost: that of the different uv's texels.
void fill_unused(Image& image, std::span<const PlantQuad> leaves);

}  // namespace manzana::foliage

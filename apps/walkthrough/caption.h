#pragma once
/// Text in a picture, without a device: the attribution that must be shown with every picture of the data.
#include <string>
#include <string_view>

#include "apps/walkthrough/png.h"

namespace manzana::walkthrough {

/// ASCII for a font that knows no more: (c) for the copyright sign, ? for everything else, one a character of UTF-8.
std::string ascii(std::string_view utf8);

/// White on a darkened ground in the lower right corner, letters growing with the picture (and shrinking to fit its
/// width, as far as they can). Empty text leaves the picture as it is.
void draw_caption(Picture& picture, std::string_view text);

}  // namespace manzana::walkthrough

#pragma once
/// Pictures as the renderer gives them, and PNG files of them.
#include <filesystem>
#include <vector>

#include "apps/common/png.h"
#include "scenegraph/draw/renderer.h"

namespace manzana::walkthrough {

/// 8-bit sRGB, three bytes a pixel, rows from the top.
struct Picture {
  draw::Size size;
  std::vector<unsigned char> rgb;
};

/// The same bytes for the same picture. Throws std::runtime_error ("FILE: what").
inline void write_png(const std::filesystem::path& file, const Picture& picture) {
  apps::write_png(file, picture.size.width, picture.size.height, picture.rgb);
}

}  // namespace manzana::walkthrough

#pragma once
#include <filesystem>
#include <span>

namespace manzana::apps {

/// 8-bit sRGB, three bytes a pixel, rows from the top. The same file for the same bytes. Throws std::runtime_error
/// ("FILE: what").
void write_png(const std::filesystem::path& file, int width, int height, std::span<const unsigned char> rgb);

}  // namespace manzana::apps

#pragma once
/// Pictures put together, with words.
///   write_sheet(file, below({heading("oak"), beside({labelled("full", a), labelled("256 px", b)})}));
#include <filesystem>
#include <span>
#include <string>

#include "apps/foliage_benchmark/picture.h"

namespace manzana::foliage_benchmark {

/// In a row, on a common floor; in a column, the first at the top, all to the left. Gaps are sky.
Picture beside(std::span<const Picture> pictures, int gap = 4);
Picture below(std::span<const Picture> pictures, int gap = 4);

/// Each pixel as a square of so many.
Picture enlarged(const Picture& picture, int times);

/// Half-open, in pixels; empty at first.
struct Box {
  int left = 1 << 30, low = 1 << 30, right = 0, high = 0;
};
Box united(const Box& a, const Box& b);
Box covered_box(const Picture& picture);  ///< of what plants cover, however little
Picture cropped(const Picture& picture, const Box& box);
Picture padded(const Picture& picture, int margin);
inline Picture trimmed(const Picture& picture) { return cropped(picture, covered_box(picture)); }

/// Padded with sky to that size, its middle in the middle, its floor on the floor. What is larger is cut off.
Picture framed(const Picture& picture, int width, int height);

/// Words in dark letters, as high as a line; ASCII.
Picture words(const std::string& text);

void write_sheet(const std::filesystem::path& file, const Picture& sheet);

}  // namespace manzana::foliage_benchmark

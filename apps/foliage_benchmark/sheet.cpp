#include "apps/foliage_benchmark/sheet.h"

#include <stb/stb_easy_font.h>

#include <algorithm>

#include "apps/common/png.h"

namespace manzana::foliage_benchmark {
namespace {

void copy(const Picture& from, Picture& to, int left, int low) {
  for (int y = std::max(0, -low); y < std::min(from.height, to.height - low); ++y)
    for (int x = std::max(0, -left); x < std::min(from.width, to.width - left); ++x)
      to.at(left + x, low + y) = from.at(x, y);
}

}  // namespace

Picture beside(std::span<const Picture> pictures, int gap) {
  int width = 0, height = 0, left = 0;
  for (const Picture& p : pictures) width += p.width + gap, height = std::max(height, p.height);
  Picture sheet = make_picture(std::max(0, width - gap), height);
  for (const Picture& p : pictures) copy(p, sheet, left, 0), left += p.width + gap;
  return sheet;
}

Picture below(std::span<const Picture> pictures, int gap) {
  int width = 0, height = 0;
  for (const Picture& p : pictures) height += p.height + gap, width = std::max(width, p.width);
  Picture sheet = make_picture(width, std::max(0, height - gap));
  int top = sheet.height;
  for (const Picture& p : pictures) copy(p, sheet, 0, top - p.height), top -= p.height + gap;
  return sheet;
}

Picture enlarged(const Picture& picture, int times) {
  Picture large = make_picture(times * picture.width, times * picture.height);
  for (int y = 0; y < large.height; ++y)
    for (int x = 0; x < large.width; ++x) large.at(x, y) = picture.at(x / times, y / times);
  return large;
}

Box united(const Box& a, const Box& b) {
  return {std::min(a.left, b.left), std::min(a.low, b.low), std::max(a.right, b.right), std::max(a.high, b.high)};
}

Box covered_box(const Picture& picture) {
  Box box;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      if (picture.at(x, y).w > 0) box = united(box, {x, y, x + 1, y + 1});
  return box;
}

Picture cropped(const Picture& picture, const Box& box) {
  Picture part = make_picture(std::max(0, box.right - box.left), std::max(0, box.high - box.low));
  copy(picture, part, -box.left, -box.low);
  return part;
}

Picture padded(const Picture& picture, int margin) {
  Picture wide = make_picture(picture.width + 2 * margin, picture.height + 2 * margin);
  copy(picture, wide, margin, margin);
  return wide;
}

Picture framed(const Picture& picture, int width, int height) {
  Picture frame = make_picture(width, height);
  copy(picture, frame, (width - picture.width) / 2, 0);
  return frame;
}

Picture words(const std::string& text) {
  constexpr int kScale = 2, kMargin = 3;
  struct Vertex {
    float x, y, z;
    unsigned char colour[4];
  };
  std::string changeable = text;  // the font asks for it
  std::vector<Vertex> corners(text.size() * 4 * 20 + 4);
  const int quads = stb_easy_font_print(0, 0, changeable.data(), nullptr, corners.data(),
                                        static_cast<int>(corners.size() * sizeof(Vertex)));
  Picture line = make_picture(kScale * stb_easy_font_width(changeable.data()) + 2 * kMargin, kScale * 12 + 2 * kMargin);
  for (int q = 0; q < quads; ++q) {
    const Vertex &a = corners[static_cast<std::size_t>(4 * q)], &b = corners[static_cast<std::size_t>(4 * q + 2)];
    for (int y = kScale * static_cast<int>(a.y); y < kScale * static_cast<int>(b.y); ++y)
      for (int x = kScale * static_cast<int>(a.x); x < kScale * static_cast<int>(b.x); ++x)
        line.at(kMargin + x, line.height - 1 - kMargin - y) = {0.01F, 0.01F, 0.01F, 1};
  }
  return line;
}

void write_sheet(const std::filesystem::path& file, const Picture& sheet) {
  apps::write_png(file, sheet.width, sheet.height, to_rgb8(sheet));
}

}  // namespace manzana::foliage_benchmark

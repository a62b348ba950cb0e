#include "apps/walkthrough/caption.h"

#include <stb/stb_easy_font.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace manzana::walkthrough {
namespace {

constexpr int kLineHeight = 10, kMargin = 3;  // font pixels; letters reach 2 below the base line at 7

struct Rect {
  int left = 0, top = 0, right = 0, bottom = 0;
};

/// Four corners as stb_easy_font writes them.
struct Quad {
  struct Corner {
    float x, y, z;
    std::uint32_t colour;
  };
  std::array<Corner, 4> corners;
};
static_assert(sizeof(Quad) == 64);

std::vector<Quad> letter_quads(std::string text) {
  std::vector<Quad> quads(text.size() * 16 + 1);
  const int count =
      stb_easy_font_print(0, 0, text.data(), nullptr, quads.data(), static_cast<int>(quads.size() * sizeof(Quad)));
  quads.resize(static_cast<std::size_t>(count));
  return quads;
}

template <class Paint>
void for_each_pixel(Picture& picture, const Rect& rect, Paint&& paint) {
  const Rect r{std::max(rect.left, 0), std::max(rect.top, 0), std::min(rect.right, picture.size.width),
               std::min(rect.bottom, picture.size.height)};
  for (int y = r.top; y < r.bottom; ++y)
    for (int x = r.left; x < r.right; ++x)
      paint(&picture.rgb[(static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.size.width) +
                          static_cast<std::size_t>(x)) *
                         3]);
}

void darken(Picture& picture, const Rect& rect) {
  for_each_pixel(picture, rect, [](unsigned char* p) {
    for (int c = 0; c < 3; ++c) p[c] = static_cast<unsigned char>(p[c] * 2 / 5);
  });
}

void whiten(Picture& picture, const Rect& rect) {
  for_each_pixel(picture, rect, [](unsigned char* p) { std::fill(p, p + 3, static_cast<unsigned char>(245)); });
}

int width_of(std::string text) { return stb_easy_font_width(text.data()); }

}  // namespace

std::string ascii(std::string_view utf8) {
  std::string out;
  for (std::size_t i = 0; i < utf8.size(); ++i) {
    const auto byte = static_cast<unsigned char>(utf8[i]);
    if (byte >= 32 && byte < 127)
      out += utf8[i];
    else if (utf8.substr(i, 2) == "\u00a9")
      out += "(c)";
    else if ((byte & 0xc0U) != 0x80U)  // the first byte of a character; those that follow say nothing more
      out += '?';
  }
  return out;
}

void draw_caption(Picture& picture, std::string_view text) {
  if (text.empty()) return;
  const std::string letters = ascii(text);
  const int width = width_of(letters) + 2 * kMargin, height = kLineHeight + 2 * kMargin;
  const int scale = std::max(1, std::min(picture.size.height / 360, picture.size.width / width));
  const Rect ground{picture.size.width - width * scale, picture.size.height - height * scale, picture.size.width,
                    picture.size.height};
  darken(picture, ground);
  const auto place = [&](float at, int origin) { return origin + (kMargin + static_cast<int>(at)) * scale; };
  for (const Quad& quad : letter_quads(letters)) {
    const auto &a = quad.corners[0], &b = quad.corners[2];
    whiten(picture, {place(a.x, ground.left), place(a.y, ground.top), place(b.x, ground.left), place(b.y, ground.top)});
  }
}

}  // namespace manzana::walkthrough

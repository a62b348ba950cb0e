#include "apps/walkthrough/caption.h"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace manzana;
using namespace manzana::walkthrough;

namespace {

Picture grey(int width, int height) {
  return {{width, height}, std::vector<unsigned char>(static_cast<std::size_t>(width * height * 3), 100)};
}

/// White pixels in a part of the picture.
int white_in(const Picture& picture, int left, int top, int right, int bottom) {
  int count = 0;
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x)
      count += picture.rgb[static_cast<std::size_t>((y * picture.size.width + x) * 3)] > 200 ? 1 : 0;
  return count;
}

}  // namespace

TEST_CASE("caption: what the font lacks becomes ASCII") {
  CHECK(ascii("\u00a9 OpenStreetMap contributors") == "(c) OpenStreetMap contributors");
  CHECK(ascii("a\u4e2db\n\xff") == "a?b??");
  CHECK(ascii("").empty());
}

TEST_CASE("caption: letters stand in the lower right corner and nowhere else") {
  Picture picture = grey(640, 360);
  draw_caption(picture, "\u00a9 OpenStreetMap contributors");
  CHECK(white_in(picture, 0, 0, 640, 340) == 0);
  CHECK(white_in(picture, 0, 340, 320, 360) == 0);
  CHECK(white_in(picture, 320, 340, 640, 360) > 200);
  CHECK(picture.rgb[0] == 100);
}

TEST_CASE("caption: larger pictures have larger letters, other texts look different") {
  Picture small = grey(1280, 720), large = grey(2560, 1440), other = grey(1280, 720);
  draw_caption(small, "(c) A");
  draw_caption(large, "(c) A");
  draw_caption(other, "(c) B");
  CHECK(white_in(large, 0, 0, 2560, 1440) == 4 * white_in(small, 0, 0, 1280, 720));
  CHECK(small.rgb != other.rgb);
}

TEST_CASE("caption: no text, no change, a picture too small for the text is not overrun") {
  Picture picture = grey(64, 64);
  draw_caption(picture, "");
  CHECK(std::all_of(picture.rgb.begin(), picture.rgb.end(), [](unsigned char c) { return c == 100; }));
  for (const int side : {1, 2, 7, 30}) {
    Picture tiny = grey(side, side);
    draw_caption(tiny, "(c) OpenStreetMap contributors");
    CHECK(tiny.rgb.size() == static_cast<std::size_t>(side * side * 3));
  }
}

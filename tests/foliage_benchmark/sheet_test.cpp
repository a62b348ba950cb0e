// Pictures put together.
#include <catch2/catch.hpp>

#include "apps/foliage_benchmark/sheet.h"

namespace manzana::foliage_benchmark {
namespace {

Picture block(int width, int height, float light) {
  Picture picture = make_picture(width, height);
  for (Vec4& texel : picture.texels) texel = Vec4(light, light, light, 1);
  return picture;
}

}  // namespace

TEST_CASE("sheet: beside stands on a common floor and below begins at the top") {
  const std::array parts{block(4, 6, 0.1F), block(2, 3, 0.2F)};
  const Picture row = beside(parts, 1);
  CHECK(row.width == 7);
  CHECK(row.height == 6);
  CHECK(row.at(5, 0).x == 0.2F);
  CHECK(row.at(5, 3).w == 0);
  const Picture column = below(parts, 1);
  CHECK(column.height == 10);
  CHECK(column.at(0, 9).x == 0.1F);
  CHECK(column.at(0, 0).x == 0.2F);
  CHECK(column.at(0, 3).w == 0);
}

TEST_CASE("sheet: a picture is cut to what it shows and enlarged pixel by pixel") {
  Picture picture = make_picture(9, 7);
  picture.at(3, 2) = picture.at(5, 4) = Vec4(0.5F, 0.5F, 0.5F, 1);
  const Picture part = trimmed(picture);
  CHECK(part.width == 3);
  CHECK(part.height == 3);
  const Picture large = enlarged(part, 4);
  CHECK(large.width == 12);
  CHECK(large.at(3, 3).w == 1);
  CHECK(large.at(4, 4).w == 0);
  const Picture frame = framed(large, 20, 5);
  CHECK(frame.at(4, 0).w == 1);
  CHECK(frame.at(3, 0).w == 0);
}

TEST_CASE("sheet: words are as long as their letters and lie within their line") {
  const Picture word = words("32 px"), longer = words("32 px, 1 024 points");
  CHECK(longer.width > word.width);
  CHECK(word.height == longer.height);
  const Box box = covered_box(longer);
  CHECK(box.left > 0);
  CHECK(box.low > 0);
  CHECK(box.right < longer.width);
  CHECK(box.high < longer.height);
}

}  // namespace manzana::foliage_benchmark

// From a picture to the square that is drawn: which row is where, what is covered, and what cannot be read.
#include "scenegraph/import/picture_square.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "apps/common/png.h"
#include "foliage/leaf_image.h"
#include "tests/support/temporary_folder.h"

using namespace manzana;

namespace {

/// Width times height, red by column, green by row from the top.
EncodedPicture write_steps(const TemporaryFolder& folder, int width, int height) {
  std::vector<unsigned char> rgb;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      rgb.insert(rgb.end(), {static_cast<unsigned char>(10 * x), static_cast<unsigned char>(10 * y), 7});
  apps::write_png(folder.path() / "steps.png", width, height, rgb);
  const auto w = static_cast<std::uint32_t>(width), h = static_cast<std::uint32_t>(height);
  return {folder.path(), "steps.png", {}, w, h, {0, 0, w, h}};
}

int mean(int a, int b) {
  const auto linear = [](int v) { return foliage::linear_of_srgb(static_cast<std::uint8_t>(v)); };
  return foliage::srgb_of_linear((linear(a) + linear(b)) / 2);
}

}  // namespace

TEST_CASE("a square has a picture's texels from the bottom and its coarser levels their means of light") {
  const TemporaryFolder folder;
  const EncodedPicture picture = write_steps(folder, 8, 8);
  CHECK(side_of(picture) == 8);
  const auto square = picture_square(picture, 8);
  REQUIRE(square);
  REQUIRE(square->size() == 4);
  for (std::uint32_t y = 0; y < 8; ++y)
    for (std::uint32_t x = 0; x < 8; ++x) {
      const GroundPhoto::Texel expected{static_cast<std::uint8_t>(10 * x), static_cast<std::uint8_t>(10 * (7 - y)), 7,
                                        255};
      CHECK((*square)[0].texels[y * 8 + x] == expected);
    }
  const GroundPhoto::Texel corner = (*square)[1].texels[0];
  CHECK(corner[0] == mean(0, 10));
  CHECK(corner[1] == mean(70, 60));
  CHECK((*picture_square(picture, 4))[0].texels[0] == corner);
}

TEST_CASE("a picture of any shape fills its square") {
  const TemporaryFolder folder;
  const EncodedPicture picture = write_steps(folder, 12, 3);
  CHECK(side_of(picture) == 8);
  const auto square = picture_square(picture, 4);
  REQUIRE(square);
  for (std::uint32_t x = 0; x < 4; ++x) CHECK((*square)[0].texels[x][1] == 20);  // of the last row alone
  CHECK((*square)[0].texels[12][1] == 0);
  CHECK((*square)[0].texels[0][0] < (*square)[0].texels[1][0]);
  CHECK((*picture_square(picture, 16))[0].texels[0][0] == 0);
  CHECK((*picture_square(picture, 16))[0].texels[15][0] == 110);
  CHECK(side_of({{}, "", {}, 60000, 60000, {0, 0, 60000, 60000}}) == kLargestSquare);
  CHECK(side_of({{}, "", {}, 9, 9, {4, 4, 1, 1}}) == 1);
}

TEST_CASE("a square has what is worn of a picture alone") {
  const TemporaryFolder folder;
  EncodedPicture picture = write_steps(folder, 12, 10);
  picture.worn = {5, 2, 4, 4};
  CHECK(side_of(picture) == 4);
  const auto square = picture_square(picture, 4);
  REQUIRE(square);
  for (std::uint32_t y = 0; y < 4; ++y)
    for (std::uint32_t x = 0; x < 4; ++x) {
      CHECK((*square)[0].texels[y * 4 + x][0] == 10 * (5 + x));
      CHECK((*square)[0].texels[y * 4 + x][1] == 10 * (5 - y));
    }
  picture.worn = {5, 7, 4, 4};  // beyond its lower edge
  CHECK(!picture_square(picture, 4));
}

TEST_CASE("a picture that is broken gone or led out of its folder since is none") {
  const TemporaryFolder folder;
  EncodedPicture picture = write_steps(folder, 4, 4);
  REQUIRE(picture_square(picture, 4));
  std::filesystem::create_directories(folder.path() / "inner");
  picture.folder = folder.path() / "inner";
  CHECK(!picture_square(picture, 4));
  std::filesystem::create_symlink(folder.path() / "steps.png", folder.path() / "inner/steps.png");
  CHECK(!picture_square(picture, 4));
  picture.folder = folder.path();
  picture.width = 5;  // another one
  CHECK(!picture_square(picture, 4));
  picture.width = 4;
  std::filesystem::resize_file(folder.path() / "steps.png", 40);
  CHECK(!picture_square(picture, 4));
  std::filesystem::remove(folder.path() / "steps.png");
  CHECK(!picture_square(picture, 4));
  CHECK_THROWS(bytes_of(picture));
}

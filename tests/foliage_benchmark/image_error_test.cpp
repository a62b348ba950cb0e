// Measures of image error: by hand, and against values that OpenCV's quality module gave for the same pictures.
#include <catch2/catch.hpp>
#include <cmath>

#include "apps/foliage_benchmark/image_error.h"
#include "culling/hash.h"

namespace manzana::foliage_benchmark {
namespace {

const Vec4 kGreen{0.1F, 0.3F, 0.05F, 1};

Picture with_square(int side, int left, int bottom, const Vec4& texel, int size = 64) {
  Picture picture = make_picture(size, size);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) picture.at(left + x, bottom + y) = texel;
  return picture;
}

/// A square of texels by chance, light and dark.
Picture speckled(std::uint64_t seed, double most) {
  Picture picture = with_square(32, 16, 16, kGreen);
  for (std::size_t i = 0; i < picture.texels.size(); ++i) {
    const double f = static_cast<double>(hash_bits(seed, i) % 1000) / 1000;
    picture.texels[i] *= static_cast<float>(1 - most * f);
    if (picture.texels[i].w > 0) picture.texels[i].w = 1;
  }
  return picture;
}

}  // namespace

TEST_CASE("image error: a picture is its own equal") {
  const Picture picture = speckled(1, 0.9);
  const ImageError error = image_error(picture, picture);
  CHECK(error.cover == 1);
  CHECK(error.iou == 1);
  CHECK(error.silhouette == 0);
  CHECK(error.colour == 0);
  CHECK(error.ssim == Approx(1).margin(1e-6));
  CHECK(error.gmsd == Approx(0).margin(1e-6));
  CHECK(error.psnr == 99);
}

TEST_CASE("image error: half a square covers half and meets itself by half") {
  const Picture whole = with_square(20, 20, 20, kGreen);
  Picture half = whole;
  for (int y = 20; y < 30; ++y)
    for (int x = 20; x < 40; ++x) half.at(x, y) = Vec4{0};
  const ImageError error = image_error(whole, half);
  CHECK(error.cover == Approx(0.5));
  CHECK(error.iou == Approx(0.5));
  CHECK(error.silhouette == Approx(0.5));
  CHECK(error.colour == Approx(0).margin(1e-7));
}

TEST_CASE("image error: a square moved by its side meets nothing and covers the same") {
  const ImageError error = image_error(with_square(10, 10, 20, kGreen), with_square(10, 20, 20, kGreen));
  CHECK(error.cover == Approx(1));
  CHECK(error.iou == 0);
  CHECK(error.silhouette == Approx(2));
}

TEST_CASE("image error: colour is the root mean square of differences of linear means") {
  const ImageError error =
      image_error(with_square(10, 10, 20, {0.2F, 0.4F, 0.1F, 1}), with_square(10, 10, 20, {0.23F, 0.36F, 0.1F, 1}));
  CHECK(error.colour == Approx(std::sqrt((0.03 * 0.03 + 0.04 * 0.04) / 3)).epsilon(1e-4));
  CHECK(error.iou == 1);
}

TEST_CASE("image error: coverage counts what is thin whatever its colour") {
  const Picture whole = with_square(10, 10, 20, kGreen);
  const Picture thin = with_square(10, 10, 20, 0.25F * kGreen);  // premultiplied
  const ImageError error = image_error(whole, thin);
  CHECK(error.cover == Approx(0.25));
  CHECK(error.iou == 0);
  CHECK(error.colour == Approx(0).margin(1e-6));
}

TEST_CASE("image error: empty sky round the plant changes nothing") {
  const auto place = [](const Picture& from, int size) {
    Picture to = make_picture(size, size);
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) to.at(x + (size - 64) / 2, y + (size - 64) / 2) = from.at(x, y);
    return to;
  };
  const Picture a = speckled(1, 0.9), b = speckled(2, 0.9);
  const ImageError narrow = image_error(a, b), wide = image_error(place(a, 200), place(b, 200));
  CHECK(narrow.ssim == Approx(wide.ssim).epsilon(1e-6));
  CHECK(narrow.gmsd == Approx(wide.gmsd).epsilon(1e-6));
  CHECK(narrow.psnr == Approx(wide.psnr).epsilon(1e-6));
  CHECK(narrow.ssim < 0.9);
  CHECK(narrow.gmsd > 0.02);
}

TEST_CASE("image error: structure as OpenCV sees it") {
  // cv::quality 4.6 of the same planes, its maps' mean (SSIM) and deviation (GMSD) over the same pixels.
  struct Known {
    double noise, ssim, gmsd;
  };
  for (const Known& known :
       {Known{0.1, 0.96425, 0.00281}, {0.3, 0.79485, 0.02447}, {0.6, 0.63027, 0.07827}, {0.9, 0.54307, 0.13634}}) {
    const ImageError error = image_error(speckled(1, known.noise), speckled(2, known.noise));
    CHECK(error.ssim == Approx(known.ssim).margin(2e-5));
    CHECK(error.gmsd == Approx(known.gmsd).margin(2e-5));
  }
}

TEST_CASE("image error: more noise is worse by every measure of structure") {
  const Picture plain = speckled(1, 0);
  double ssim = 1, gmsd = 0, psnr = 99;
  for (const double noise : {0.1, 0.3, 0.6, 0.9}) {
    const ImageError error = image_error(plain, speckled(2, noise));
    CHECK(error.ssim < ssim);
    CHECK(error.gmsd > gmsd);
    CHECK(error.psnr < psnr);
    ssim = error.ssim;
    gmsd = error.gmsd;
    psnr = error.psnr;
  }
}

TEST_CASE("steps: nothing moves in a still picture and one pixel in two hundred is strong") {
  const Picture before = with_square(20, 20, 20, kGreen);
  CHECK(step_between(before, before).mean == 0);
  Picture after = before;
  after.at(25, 25) = after.at(30, 30) = {1, 1, 1, 1};
  const Step step = step_between(before, after);
  const double jump = static_cast<double>(1 - to_srgb(0.05F));
  CHECK(step.strong == Approx(jump));
  CHECK(step.most == Approx(jump));
  CHECK(step.mean == Approx(2 * jump / 400));
}

TEST_CASE("sRGB: there and back, and the standard's own values") {
  for (const float x : {0.0F, 0.001F, 0.0031308F, 0.18F, 0.5F, 1.0F})
    CHECK(from_srgb(to_srgb(x)) == Approx(x).margin(1e-6));
  CHECK(to_srgb(0.5F) == Approx(0.7353570).epsilon(1e-5));
  CHECK(to_srgb(-1) == 0);
  CHECK(to_srgb(2) == Approx(1));
}

}  // namespace manzana::foliage_benchmark

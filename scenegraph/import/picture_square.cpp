#include "scenegraph/import/picture_square.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "foliage/import/folder_files.h"
#include "foliage/import/plant_image.h"
#include "foliage/leaf_image.h"

namespace manzana {
namespace {

constexpr std::uint64_t kMostBytes = 64U << 20;  // of a picture's file, as at import

/// What texel i of n covers of `size` pixels: visit(pixel, share), the shares of a texel make 1.
template <class Visit>
void covered(std::size_t i, std::size_t n, std::size_t size, Visit&& visit) {
  const double step = static_cast<double>(size) / static_cast<double>(n);
  const double from = static_cast<double>(i) * step, to = static_cast<double>(i + 1) * step;
  for (auto p = static_cast<std::size_t>(from); p < size && static_cast<double>(p) < to; ++p) {
    const double at = static_cast<double>(p);
    visit(p, static_cast<float>((std::min(to, at + 1) - std::max(from, at)) / step));
  }
}

/// Linear light times alpha, and alpha, of a row of the part stretched to so many texels.
std::vector<Vec4> stretched_row(const foliage::Picture& picture, const PicturePart& part, std::size_t row,
                                std::size_t side) {
  const std::size_t width = part.width;
  const std::uint8_t* first =
      &picture.rgba[4 * ((part.top + row) * static_cast<std::size_t>(picture.width) + part.left)];
  const foliage::LinearBytes& linear = foliage::linear_of_srgb();
  std::vector<Vec4> light(width), texels(side, Vec4(0));
  for (std::size_t x = 0; x < width; ++x) {
    const std::uint8_t* p = first + 4 * x;
    light[x] = Vec4(linear[p[0]], linear[p[1]], linear[p[2]], 1) * (static_cast<float>(p[3]) / 255);
  }
  for (std::size_t x = 0; x < side; ++x)
    covered(x, side, width, [&](std::size_t from, float share) { texels[x] += light[from] * share; });
  return texels;
}

GroundPhoto::Texel packed(const Vec4& light) {
  GroundPhoto::Texel texel;
  for (int c = 0; c < 3; ++c) texel[static_cast<std::size_t>(c)] = foliage::srgb_of_linear(light[c]);
  texel[3] = static_cast<std::uint8_t>(std::lround(std::clamp(light.w, 0.0F, 1.0F) * 255));
  return texel;
}

/// Rows of a picture go from the top, those of a square from the bottom.
GroundPhoto::Level stretched(const foliage::Picture& picture, const PicturePart& part, std::uint32_t side) {
  GroundPhoto::Level level{side, side, {}};
  level.texels.reserve(std::size_t{side} * side);
  const std::size_t height = part.height;
  std::size_t known = height;  // the row that `row` is of
  std::vector<Vec4> row, sum;
  for (std::size_t y = side; y-- > 0;) {
    sum.assign(side, Vec4(0));
    covered(y, side, height, [&](std::size_t from, float share) {
      if (from != known) row = stretched_row(picture, part, known = from, side);
      for (std::size_t x = 0; x < side; ++x) sum[x] += row[x] * share;
    });
    std::ranges::transform(sum, std::back_inserter(level.texels), packed);
  }
  return level;
}

bool has(const foliage::Picture& decoded, const EncodedPicture& picture) {
  const auto reaches = [](std::uint32_t first, std::uint32_t n, std::uint32_t all) {
    return n > 0 && first < all && n <= all - first;
  };
  return static_cast<std::uint32_t>(decoded.width) == picture.width &&
         static_cast<std::uint32_t>(decoded.height) == picture.height &&
         reaches(picture.worn.left, picture.worn.width, picture.width) &&
         reaches(picture.worn.top, picture.worn.height, picture.height);
}

}  // namespace

std::vector<unsigned char> bytes_of(const EncodedPicture& picture) {
  if (!picture.bytes.empty()) {
    const auto* first = reinterpret_cast<const unsigned char*>(picture.bytes.data());
    std::vector<unsigned char> bytes(first, first + picture.bytes.size());
    picture.bytes.let_go(0, picture.bytes.size());
    return bytes;
  }
  auto bytes = foliage::FolderFiles(picture.folder, kMostBytes).read(picture.name);
  if (!bytes) throw std::runtime_error("the picture " + picture.name + " is not there any more");
  return std::move(*bytes);
}

std::optional<PictureSquare> picture_square(const EncodedPicture& picture, std::uint32_t side) {
  try {
    const foliage::Picture decoded = foliage::decode_picture(bytes_of(picture));
    if (!has(decoded, picture)) return std::nullopt;  // it is another one by now
    PictureSquare square{stretched(decoded, picture.worn, side)};
    tbb::task_arena(1).execute([&] { add_levels(square); });  // on this thread alone
    return square;
  } catch (const std::exception&) {
    return std::nullopt;  // what wears it keeps its mean colour
  }
}

}  // namespace manzana

#include "foliage/import/plant_image.h"

#include <stb_image.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "foliage/leaf_image.h"

namespace manzana::foliage {
namespace {

constexpr std::uint64_t kMaxPixels = 16U << 20;

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error(what); }

bool starts_with(std::span<const unsigned char> bytes, std::span<const unsigned char> magic) {
  return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
}

constexpr std::array<unsigned char, 8> kPng{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
constexpr std::array<unsigned char, 3> kJpeg{0xFF, 0xD8, 0xFF};

std::uint32_t big_endian(std::span<const unsigned char> bytes, std::size_t at) {
  return static_cast<std::uint32_t>(bytes[at]) << 24 | static_cast<std::uint32_t>(bytes[at + 1]) << 16 |
         static_cast<std::uint32_t>(bytes[at + 2]) << 8 | static_cast<std::uint32_t>(bytes[at + 3]);
}

/// Counts what a PNG's IDAT chunks inflate to, in little memory: the decoder would take it all first.
class InflatedSize {
 public:
  InflatedSize() {
    if (inflateInit(&stream_) != Z_OK) fail("zlib does not start");
  }
  ~InflatedSize() { inflateEnd(&stream_); }
  InflatedSize(const InflatedSize&) = delete;
  InflatedSize& operator=(const InflatedSize&) = delete;

  /// False at the stream's end or where it is broken: the decoder says more.
  bool feed(std::span<const unsigned char> bytes, std::uint64_t limit) {
    std::array<unsigned char, 65536> out;
    stream_.next_in = const_cast<unsigned char*>(bytes.data());  // zlib's interface has no const
    stream_.avail_in = static_cast<uInt>(bytes.size());
    while (stream_.avail_in > 0) {
      stream_.next_out = out.data();
      stream_.avail_out = static_cast<uInt>(out.size());
      const int state = inflate(&stream_, Z_NO_FLUSH);
      total_ += out.size() - stream_.avail_out;
      if (total_ > limit) fail("a PNG inflates to more than its pixels");
      if (state != Z_OK) return false;
    }
    return true;
  }

 private:
  z_stream stream_{};
  std::uint64_t total_ = 0;
};

void check_png(std::span<const unsigned char> bytes, std::uint64_t pixels) {
  InflatedSize size;
  const std::uint64_t limit = pixels * 8 + (1U << 20);  // 16 bits, 4 channels; a filter byte a row
  for (std::size_t at = kPng.size(); at + 12 <= bytes.size();) {
    const std::uint64_t length = big_endian(bytes, at);
    if (length > bytes.size() - at - 12) return;
    const auto type = bytes.subspan(at + 4, 4);
    constexpr std::array<unsigned char, 4> kData{'I', 'D', 'A', 'T'};
    if (std::equal(type.begin(), type.end(), kData.begin()) &&
        !size.feed(bytes.subspan(at + 8, static_cast<std::size_t>(length)), limit))
      return;
    at += static_cast<std::size_t>(length) + 12;
  }
}

struct StbFree {
  void operator()(stbi_uc* data) const { stbi_image_free(data); }
};

std::vector<float> linear_table() {
  std::vector<float> table;
  for (int i = 0; i < 256; ++i) table.push_back(linear_of_srgb(static_cast<std::uint8_t>(i)));
  return table;
}

/// Source pixels [first, last) that one texel covers, at least one.
struct Span {
  int first, last;
};
Span covered(int texel, int source) {
  const auto at = [&](int t) { return static_cast<int>(std::int64_t{t} * source / kPlantImageSize); };
  return {at(texel), std::max(at(texel + 1), at(texel) + 1)};
}

/// Mean linear colour, weighted by alpha, and mean alpha.
Vec4 mean(const Picture& picture, const std::vector<float>& linear, const Span& xs, const Span& ys) {
  Vec3 colour(0), plain(0);
  float alpha = 0;
  for (int y = ys.first; y < ys.last; ++y) {
    for (int x = xs.first; x < xs.last; ++x) {
      const std::uint8_t* p = &picture.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                                                 static_cast<std::size_t>(x))];
      const Vec3 c(linear[p[0]], linear[p[1]], linear[p[2]]);
      const float a = static_cast<float>(p[3]) / 255;
      colour += c * a;
      plain += c;
      alpha += a;
    }
  }
  const auto count = static_cast<float>((xs.last - xs.first) * (ys.last - ys.first));
  return Vec4(alpha > 0 ? colour / alpha : plain / count, alpha / count);
}

float cut_alpha(float alpha, const Tint& tint) {
  if (!tint.alpha_cutoff) return 1;
  const float cutoff = std::clamp(*tint.alpha_cutoff, 0.01F, 0.99F);
  return std::clamp(alpha * tint.factor.w * 0.5F / cutoff, 0.0F, 1.0F);
}

}  // namespace

Picture decode_picture(std::span<const unsigned char> bytes) {
  const bool png = starts_with(bytes, kPng);
  if (!png && !starts_with(bytes, kJpeg)) fail("a texture is neither PNG nor JPEG");
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (stbi_info_from_memory(bytes.data(), size, &width, &height, &channels) == 0 || width <= 0 || height <= 0)
    fail("a texture cannot be decoded");
  const std::uint64_t pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  if (pixels > kMaxPixels) fail("a texture has more than 16 Mi pixels");
  if (png) check_png(bytes, pixels);
  const std::unique_ptr<stbi_uc, StbFree> data(
      stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, 4));
  if (!data) fail("a texture cannot be decoded");
  return {width, height, {data.get(), data.get() + 4 * pixels}};
}

Image plant_image(const Picture& picture, const Tint& tint) {
  const std::vector<float> linear = linear_table();
  Image image{kPlantImageSize, {}};
  image.rgba.resize(std::size_t{4} * kPlantImageSize * kPlantImageSize);
  std::uint8_t* texel = image.rgba.data();
  for (int y = 0; y < kPlantImageSize; ++y) {
    for (int x = 0; x < kPlantImageSize; ++x, texel += 4) {
      const Vec4 value = mean(picture, linear, covered(x, picture.width), covered(y, picture.height));
      for (int c = 0; c < 3; ++c) texel[c] = srgb_of_linear(value[c] * tint.factor[c]);
      texel[3] = static_cast<std::uint8_t>(std::lround(255 * cut_alpha(value.w, tint)));
    }
  }
  dilate_colour(image);
  return image;
}

Picture plain_picture() { return {1, 1, {255, 255, 255, 255}}; }

}  // namespace manzana::foliage

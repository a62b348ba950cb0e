// Pictures by GDAL, turned into squares in plan. Where a square's middle lies in the picture is asked of PROJ every so
// many squares, and interpolated between: within 100 m any projection is flat to a thousandth of a metre.
#include "scenegraph/import/read_photo.h"

#include <stdexcept>

#ifndef MANZANA_GDAL

manzana::GroundPhoto manzana::read_ground_photo(const std::filesystem::path& file, const LocalFrame&,
                                                const culling::BoxD&, const std::string&) {
  throw std::runtime_error(file.string() + ": this build is without GDAL (libgdal-dev), which reads orthophotos");
}

#else

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "foliage/leaf_image.h"
#include "scenegraph/import/raster_place.h"

namespace manzana {
namespace {

using Texel = GroundPhoto::Texel;
using glm::ivec2;

constexpr double kBeyond = 400;        // metres of ground round the city
constexpr std::uint32_t kMost = 8192;  // squares a side
constexpr int kTile = 512;             // squares that are read at once
constexpr int kSpan = 32;              // squares between places that are asked for
constexpr int kSpans = kTile / kSpan;

struct Rect {
  Vec2d low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
  void add(const Vec2d& p) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return;
    low = glm::min(low, p), high = glm::max(high, p);
  }
  bool empty() const { return !(low.x < high.x && low.y < high.y); }
};
Rect common(const Rect& a, const Rect& b) { return {glm::max(a.low, b.low), glm::min(a.high, b.high)}; }

/// Of the picture in plan, by its edges.
Rect extent(const RasterPlace& place, const LocalFrame& frame, const Vec2d& size) {
  constexpr int kParts = 64;
  Rect rect;
  for (int i = 0; i <= kParts; ++i) {
    const double t = static_cast<double>(i) / kParts;
    for (const Vec2d& edge : {Vec2d(t, 0), Vec2d(t, 1), Vec2d(0, t), Vec2d(1, t)})
      rect.add(place.plan_of(frame, edge * size));
  }
  return rect;
}

/// A window of the picture, reduced.
struct Window {
  Vec2d low{0}, high{0};  ///< pixels of the file
  ivec2 size{0};
  std::vector<Texel> pixels;  ///< sRGB and alpha, not multiplied
};

class Picture {
 public:
  explicit Picture(GDALDataset& data) : data_(data), size_(data.GetRasterXSize(), data.GetRasterYSize()) {
    const int bands = data.GetRasterCount();
    if (bands < 1) throw std::runtime_error("holds no picture");
    for (int b = 1; b <= std::min(bands, 3); ++b)
      if (const GDALDataType type = data.GetRasterBand(b)->GetRasterDataType(); type != GDT_Byte)
        throw std::runtime_error(std::string("has samples of ") + GDALGetDataTypeName(type) + "; only Byte is drawn");
    grey_ = bands < 3;
    palette_ = bands == 1 ? data.GetRasterBand(1)->GetColorTable() : nullptr;
  }
  Vec2d size() const { return size_; }

  /// What of the rectangle there is, at most so many pixels a side.
  Window read(const Rect& rect, int most) const {
    Window w;
    w.low = glm::clamp(glm::floor(rect.low) - 1.0, Vec2d(0), size_);
    w.high = glm::clamp(glm::ceil(rect.high) + 1.0, Vec2d(0), size_);
    const Vec2d full = w.high - w.low;
    if (full.x < 1 || full.y < 1) return w;
    w.size = ivec2(glm::ceil(full / std::max(1.0, std::max(full.x, full.y) / most)));
    w.pixels.resize(static_cast<std::size_t>(w.size.x) * static_cast<std::size_t>(w.size.y), Texel{0, 0, 0, 255});
    for (int c = 0; c < 3; ++c) read(w, *data_.GetRasterBand(grey_ ? 1 : c + 1), static_cast<std::size_t>(c));
    read(w, *data_.GetRasterBand(1)->GetMaskBand(), 3);
    if (palette_ != nullptr) look_up(w);
    return w;
  }

 private:
  void read(Window& w, GDALRasterBand& band, std::size_t channel) const {
    GDALRasterIOExtraArg how;
    INIT_RASTERIO_EXTRA_ARG(how);
    how.eResampleAlg = palette_ != nullptr ? GRIORA_NearestNeighbour : GRIORA_Average;
    const ivec2 low(w.low), full(w.high - w.low);
    if (band.RasterIO(GF_Read, low.x, low.y, full.x, full.y, w.pixels.data()->data() + channel, w.size.x, w.size.y,
                      GDT_Byte, sizeof(Texel), static_cast<GSpacing>(sizeof(Texel)) * w.size.x, &how) != CE_None)
      throw std::runtime_error("its pixels cannot be read");
  }
  void look_up(Window& w) const {
    for (Texel& t : w.pixels) {
      const GDALColorEntry* e = palette_->GetColorEntry(t[0]);
      if (e == nullptr) e = palette_->GetColorEntry(0);
      const auto byte = [](int v) { return static_cast<std::uint8_t>(v); };
      t = {byte(e->c1), byte(e->c2), byte(e->c3), byte(t[3] * e->c4 / 255)};
    }
  }

  GDALDataset& data_;
  Vec2d size_;
  bool grey_ = false;
  const GDALColorTable* palette_ = nullptr;
};

/// Between the four pixels around, in linear light; nothing beyond the window. `at`: pixels of the file.
Texel sample(const Window& w, const Vec2d& at) {
  if (!(at.x >= w.low.x && at.y >= w.low.y && at.x < w.high.x && at.y < w.high.y)) return {};
  const Vec2d p = (at - w.low) / (w.high - w.low) * Vec2d(w.size) - 0.5, cell = glm::floor(p), t = p - cell;
  Vec4 sum(0);
  for (const ivec2 corner : {ivec2(0, 0), ivec2(1, 0), ivec2(0, 1), ivec2(1, 1)}) {
    const ivec2 pixel = glm::clamp(ivec2(cell) + corner, ivec2(0), w.size - 1);
    const Texel& v = w.pixels[static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(w.size.x) +
                              static_cast<std::size_t>(pixel.x)];
    const double weight = (corner.x == 1 ? t.x : 1 - t.x) * (corner.y == 1 ? t.y : 1 - t.y) * v[3] / 255.0;
    sum += static_cast<float>(weight) *
           Vec4(foliage::linear_of_srgb(v[0]), foliage::linear_of_srgb(v[1]), foliage::linear_of_srgb(v[2]), 1);
  }
  sum = glm::min(sum, Vec4(1));
  return {foliage::srgb_of_linear(sum.x), foliage::srgb_of_linear(sum.y), foliage::srgb_of_linear(sum.z),
          static_cast<std::uint8_t>(sum.w * 255 + 0.5F)};
}

/// Where the squares of a tile lie in the picture.
class TilePlaces {
 public:
  TilePlaces(const RasterPlace& place, const LocalFrame& frame, const GroundPhoto& photo, const ivec2& first) {
    for (int r = 0; r <= kSpans; ++r)
      for (int c = 0; c <= kSpans; ++c) {
        nodes_.push_back(place.pixel_of(frame, photo.origin + photo.step * Vec2d(first + kSpan * ivec2(c, r))));
        bounds_.add(nodes_.back());
      }
  }
  const Rect& bounds() const { return bounds_; }
  Vec2d of(int column, int row) const {
    const Vec2d at = (Vec2d(column, row) + 0.5) / double{kSpan}, cell = glm::floor(at), t = at - cell;
    const auto node = [&](int right, int up) {
      return nodes_[static_cast<std::size_t>((static_cast<int>(cell.y) + up) * (kSpans + 1) + static_cast<int>(cell.x) +
                                             right)];
    };
    return glm::mix(glm::mix(node(0, 0), node(1, 0), t.x), glm::mix(node(0, 1), node(1, 1), t.x), t.y);
  }

 private:
  std::vector<Vec2d> nodes_;
  Rect bounds_;
};

void fill_tile(GroundPhoto& photo, const ivec2& first, const TilePlaces& places, const Window& window) {
  GroundPhoto::Level& level = photo.levels[0];
  const ivec2 size = glm::min(ivec2(kTile), ivec2(level.columns, level.rows) - first);
  tbb::parallel_for(0, size.y, [&](int r) {
    Texel* row =
        &level.texels[static_cast<std::size_t>(first.y + r) * level.columns + static_cast<std::size_t>(first.x)];
    for (int c = 0; c < size.x; ++c) row[c] = sample(window, places.of(c, r));
  });
}

GroundPhoto read(GDALDataset& data, const LocalFrame& frame, const culling::BoxD& city,
                 const std::string& reference_system) {
  const Picture picture(data);
  const RasterPlace place(data, reference_system);
  const Rect wanted{Vec2d(city.min) - kBeyond, Vec2d(city.max) + kBeyond};
  const Rect rect = common(wanted, extent(place, frame, picture.size()));
  if (city.empty() || rect.empty()) throw std::runtime_error("does not reach the city");
  const Vec2d size = rect.high - rect.low;
  GroundPhoto photo;
  photo.origin = rect.low;
  photo.step = std::max(place.pixel_size(frame, rect.low + size / 2.0), std::max(size.x, size.y) / (kMost - 1));
  GroundPhoto::Level& level = photo.levels.emplace_back();
  level.columns = static_cast<std::uint32_t>(std::ceil(size.x / photo.step));
  level.rows = static_cast<std::uint32_t>(std::ceil(size.y / photo.step));
  level.texels.resize(std::size_t{level.columns} * level.rows);
  for (int r = 0; r < static_cast<int>(level.rows); r += kTile)
    for (int c = 0; c < static_cast<int>(level.columns); c += kTile) {
      const TilePlaces places(place, frame, photo, {c, r});
      fill_tile(photo, {c, r}, places, picture.read(places.bounds(), 2 * kTile));
    }
  if (std::ranges::all_of(level.texels, [](const Texel& t) { return t[3] == 0; }))
    throw std::runtime_error("has nothing where the city is");
  add_levels(photo.levels);
  return photo;
}

}  // namespace

GroundPhoto read_ground_photo(const std::filesystem::path& file, const LocalFrame& frame, const culling::BoxD& city,
                              const std::string& reference_system) {
  try {
    const GdalFile dataset(file, GDAL_OF_RASTER, {"GTiff", "PNG", "JPEG"});
    return read(*dataset, frame, city, reference_system);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

}  // namespace manzana

#endif

// Rasters by GDAL: heights at the corners of a grid in plan.
#include <stdexcept>

#include "scenegraph/import/terrain.h"

#ifndef MANZANA_GDAL

manzana::Terrain manzana::read_terrain(const std::filesystem::path& file, const CityFeatures&) {
  throw std::runtime_error(file.string() + ": this build is without GDAL (libgdal-dev), which reads terrain");
}

#else

#include <algorithm>
#include <cmath>
#include <limits>

#include "culling/volumes.h"
#include "scenegraph/import/raster_place.h"

namespace manzana {
namespace {

constexpr double kBeyond = 400;        // metres of ground round the city
constexpr double kFinest = 5;          // metres a cell
constexpr std::uint32_t kMost = 4000;  // corners a side
constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();

/// Of all features, in plan.
culling::BoxD bounds_of(const CityFeatures& city) {
  culling::BoxD box;
  const auto add = [&](const Vec2d& p) {
    if (std::isfinite(p.x) && std::isfinite(p.y)) box = merge(box, Vec3d(p, 0));
  };
  for (const BuildingFeature& b : city.buildings) std::ranges::for_each(b.footprint.outer, add);
  for (const ConstructionFeature& c : city.constructions)
    for (const Vec3d& p : c.points) add(Vec2d(p));
  for (const StreetFeature& s : city.streets) std::ranges::for_each(s.line, add);
  for (const TreeFeature& t : city.trees) add(t.position);
  for (const PlacedPlant& p : city.plants) add(Vec2d(p.position));
  for (const AreaFeature& a : city.areas) std::ranges::for_each(a.shape.outer, add);
  return box;
}

/// A window of the raster's first band; pixels outside it, and without a value, are void.
class Raster {
 public:
  explicit Raster(GDALDataset& data) : band_(*data.GetRasterBand(1)), place_(data) {
    int has = 0;
    const double none = band_.GetNoDataValue(&has);
    if (has != 0) none_ = static_cast<float>(none);
  }

  /// Pixels, the middle of the first being (0, 0).
  Vec2d pixel_of(const LocalFrame& frame, const Vec2d& plan) const { return place_.pixel_of(frame, plan) - 0.5; }
  const RasterPlace& place() const { return place_; }

  void load(const Vec2d& low, const Vec2d& high) {
    const Vec2d most(band_.GetXSize(), band_.GetYSize());
    const Vec2d first = glm::clamp(glm::floor(low) - 1.0, Vec2d(0), most),
                last = glm::clamp(glm::ceil(high) + 2.0, Vec2d(0), most);
    first_ = glm::ivec2(first);
    size_ = glm::ivec2(last) - first_;
    if (size_.x < 1 || size_.y < 1) throw std::runtime_error("does not reach the city");
    pixels_.resize(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y));
    if (band_.RasterIO(GF_Read, first_.x, first_.y, size_.x, size_.y, pixels_.data(), size_.x, size_.y, GDT_Float32, 0,
                       0) != CE_None)
      throw std::runtime_error("its heights cannot be read");
  }

  /// Between the four around; void where one of them is.
  float height(const Vec2d& pixel) const {
    const Vec2d cell = glm::floor(pixel), t = pixel - cell;
    const auto at = [&](double right, double down) {
      return static_cast<double>(value(cell.x + right, cell.y + down));
    };
    if (!std::isfinite(pixel.x) || !std::isfinite(pixel.y)) return kVoid;
    const double top = std::lerp(at(0, 0), at(1, 0), t.x), bottom = std::lerp(at(0, 1), at(1, 1), t.x);
    return static_cast<float>(std::lerp(top, bottom, t.y));
  }

 private:
  float value(double column, double row) const {
    const Vec2d at = Vec2d(column, row) - Vec2d(first_);
    if (!(at.x >= 0 && at.y >= 0 && at.x < size_.x && at.y < size_.y)) return kVoid;
    const float h =
        pixels_[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(size_.x) + static_cast<std::size_t>(at.x)];
    return h == none_ || !(std::abs(h) < 12000) ? kVoid : h;
  }

  GDALRasterBand& band_;
  RasterPlace place_;
  float none_ = kVoid;
  glm::ivec2 first_{0}, size_{0};
  std::vector<float> pixels_;
};

Terrain grid_for(const culling::BoxD& box, double step) {
  Terrain grid;
  const Vec2d low = Vec2d(box.min) - kBeyond, size = Vec2d(box.max) + kBeyond - low;
  grid.step = std::max({step, kFinest, std::max(size.x, size.y) / (kMost - 2)});
  grid.origin = low;
  grid.columns = static_cast<std::uint32_t>(std::ceil(size.x / grid.step)) + 1;
  grid.rows = static_cast<std::uint32_t>(std::ceil(size.y / grid.step)) + 1;
  return grid;
}

/// Ring by ring from those that have a height.
void fill_voids(Terrain& grid) {
  const auto columns = static_cast<std::int64_t>(grid.columns), rows = static_cast<std::int64_t>(grid.rows);
  for (bool some = true; some;) {
    some = false;
    const std::vector<float> before = grid.heights;
    for (std::int64_t r = 0; r < rows; ++r)
      for (std::int64_t c = 0; c < columns; ++c) {
        float& h = grid.heights[static_cast<std::size_t>(r * columns + c)];
        if (!std::isnan(h)) continue;
        float sum = 0, count = 0;
        for (std::int64_t y = std::max<std::int64_t>(r - 1, 0); y <= std::min(r + 1, rows - 1); ++y)
          for (std::int64_t x = std::max<std::int64_t>(c - 1, 0); x <= std::min(c + 1, columns - 1); ++x)
            if (const float other = before[static_cast<std::size_t>(y * columns + x)]; !std::isnan(other))
              sum += other, count += 1;
        if (count > 0) h = sum / count, some = true;
      }
  }
}

Terrain read(GDALDataset& data, const CityFeatures& city) {
  if (data.GetRasterCount() < 1) throw std::runtime_error("holds no raster");
  const culling::BoxD box = bounds_of(city);
  if (box.empty()) return {};
  Raster raster(data);
  Terrain grid = grid_for(box, raster.place().pixel_size(city.frame, Vec2d(center(box))));
  std::vector<Vec2d> pixels;
  Vec2d low(std::numeric_limits<double>::infinity()), high = -low;
  for (std::uint32_t r = 0; r < grid.rows; ++r)
    for (std::uint32_t c = 0; c < grid.columns; ++c) {
      const Vec2d p = pixels.emplace_back(raster.pixel_of(city.frame, grid.origin + grid.step * Vec2d(c, r)));
      if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  raster.load(low, high);
  for (const Vec2d& pixel : pixels) grid.heights.push_back(raster.height(pixel));
  if (std::ranges::all_of(grid.heights, [](float h) { return std::isnan(h); }))
    throw std::runtime_error("has no heights where the city is");
  fill_voids(grid);
  const float base = *std::ranges::min_element(grid.heights);
  for (float& h : grid.heights) h -= base;
  grid.base_m = static_cast<double>(base);
  return grid;
}

}  // namespace

Terrain read_terrain(const std::filesystem::path& file, const CityFeatures& city) {
  try {
    const GdalFile dataset(file, GDAL_OF_RASTER, {"GTiff", "SRTMHGT"});
    return read(*dataset, city);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

}  // namespace manzana

#endif

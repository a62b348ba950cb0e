#include "foliage/square_picture.h"

#include <algorithm>
#include <cmath>

#include "foliage/leaf_image.h"
#include "foliage/point_shade.h"
#include "foliage/raster.h"

namespace manzana::foliage {
namespace {

float light_of(const LeafPoint& point) {
  const auto channel = [&](int shift) { return linear_of_srgb(static_cast<std::uint8_t>(point.colour >> shift)); };
  return luminance({channel(0), channel(8), channel(16)}) * arriving(point.shade);
}

}  // namespace

float square_pixel_m(const PreparedPlant& plant) {
  return 2 * std::max(plant.height_m, 2 * plant.crown_radius_m) / kSquarePixels;
}

SquareSight::SquareSight(const PreparedPlant& plant, float up, float azimuth)
    : middle_(0, 0, plant.height_m / 2), right_(-std::sin(azimuth), std::cos(azimuth), 0) {
  const float level = std::sqrt(1 - up * up), c = std::cos(azimuth), s = std::sin(azimuth);
  top_ = Vec3(-up * c, -up * s, level);
  towards_ = Vec3(level * c, level * s, up);
  per_m_ = 1 / square_pixel_m(plant);
}

Square SquareSight::square(const LeafPoint& point, float scale) const {
  const Vec3 p = point.position - middle_;
  return {Vec2(glm::dot(p, right_), glm::dot(p, top_)) * per_m_ + 0.5F * kSquarePixels, glm::dot(p, towards_),
          scale * point.area * per_m_ * per_m_, light_of(point)};
}

std::vector<Square> SquareSight::squares(std::span<const LeafPoint> points) const {
  std::vector<Square> all;
  for (const LeafPoint& point : points) all.push_back(square(point));
  return all;
}

SeenSquares SquarePicture::draw(std::span<const Square> squares, float scale) {
  ++picture_;
  SeenSquares seen;
  for (const Square& square : squares) {
    const float half = 0.5F * std::sqrt(square.area * scale);
    const auto pixel = [](float v) { return first_pixel(v, kSquarePixels); };
    for (int y = pixel(square.middle.y - half); y < pixel(square.middle.y + half); ++y)
      for (int x = pixel(square.middle.x - half); x < pixel(square.middle.x + half); ++x)
        put(square, pixels_[static_cast<std::size_t>(y * kSquarePixels + x)], seen);
  }
  return seen;
}

void SquarePicture::count(std::span<const Square> squares, std::span<std::uint32_t> pixels) {
  draw(squares, 1);
  for (const Pixel& pixel : pixels_)
    if (pixel.picture == picture_) ++pixels[static_cast<std::size_t>(pixel.nearest - squares.data())];
}

void SquarePicture::put(const Square& square, Pixel& there, SeenSquares& seen) const {
  const bool first = there.picture != picture_;
  if (!first && there.nearest->nearness >= square.nearness) return;
  seen.pixels += first ? 1 : 0;
  seen.light += static_cast<double>(square.light - (first ? 0 : there.nearest->light));
  there = {&square, picture_};
}

}  // namespace manzana::foliage

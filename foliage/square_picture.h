#pragma once
/// Small pictures of points as squares that face the eye, by parallel rays, for fitting groves to them.
///   const SquareSight sight(plant, 0.5F, azimuth);
///   SquarePicture picture;
///   SeenSquares seen = picture.draw(sight.squares(points), 1);
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "foliage/prepared_plant.h"

namespace manzana::foliage {

inline constexpr int kSquarePixels = 128;  ///< a side

/// As the eye sees it, in pixels; its area in them.
struct Square {
  Vec2 middle;
  float nearness, area, light;
};

/// How large a plant's pixels are, so that all of it is seen from everywhere.
float square_pixel_m(const PreparedPlant& plant);

/// From all round the middle of a plant.
class SquareSight {
 public:
  /// `up`: sine of the eye's elevation; `azimuth` in radians.
  SquareSight(const PreparedPlant& plant, float up, float azimuth);
  /// Its area times `scale`.
  Square square(const LeafPoint& point, float scale = 1) const;
  std::vector<Square> squares(std::span<const LeafPoint> points) const;

 private:
  Vec3 middle_, right_, top_, towards_;
  float per_m_;
};

struct SeenSquares {
  double pixels = 0, light = 0;  ///< covered; sum over them of the nearest's
};

class SquarePicture {
 public:
  /// Areas times `scale`.
  SeenSquares draw(std::span<const Square> squares, float scale);
  /// Adds to each square's the pixels where it is the nearest.
  void count(std::span<const Square> squares, std::span<std::uint32_t> pixels);

 private:
  struct Pixel {
    const Square* nearest = nullptr;
    std::uint32_t picture = 0;  // of an earlier one: nothing is there
  };
  void put(const Square& square, Pixel& there, SeenSquares& seen) const;

  std::array<Pixel, std::size_t{kSquarePixels} * kSquarePixels> pixels_{};
  std::uint32_t picture_ = 0;
};

}  // namespace manzana::foliage

#pragma once
/// Cars made by code: a body lofted over sections from front to rear, a greenhouse, wheels, lights; in levels of
/// detail. Frame: wheels stand on z = 0, y forward, origin in the middle, metres. No vertex is farther than kCarRadius
/// away.
///   CarMesh mesh = make_car(CarBody::saloon, 0);
#include <array>
#include <cstdint>
#include <vector>

#include "culling/vec.h"

namespace manzana::draw {

enum class CarBody : std::uint8_t { saloon, hatchback, van, count };
inline constexpr std::size_t kCarBodies = static_cast<std::size_t>(CarBody::count);
inline constexpr std::size_t kCarLevels = 4;

/// Down to so many pixels of the car's radius each level is all that is drawn; it then gives way to the next, and is
/// gone where the car is kCarFade times smaller. [numerics 13.4]
inline constexpr std::array<double, kCarLevels> kCarMinRadiusPx{70, 26, 9, 0};
inline constexpr double kCarFade = 1.25;

/// Colours are the shader's (car.vert), but for paint, which is the instance's.
enum class CarPart : std::uint32_t { paint, glass, rubber, metal, head_light, tail_light };

struct CarVertex {
  Vec3 position;
  std::uint32_t normal;  ///< signed normalised 10-10-10-2
  CarPart part;
};

struct CarMesh {
  std::vector<CarVertex> vertices;
  std::vector<std::uint32_t> indices;
};

/// level 0 is the finest; about 1000, 260, 60 and 18 triangles.
CarMesh make_car(CarBody body, std::size_t level);

/// Linear colour of a car's paint, from the frequencies of what stands in streets.
Vec3 car_paint(std::uint32_t car);
CarBody car_body(std::uint32_t car);

}  // namespace manzana::draw

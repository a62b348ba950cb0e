#pragma once
/// A generated city for the tests and measurements of culling: a jittered grid of blocks with buildings and trees, the
/// same on every machine; and a camera path after figure 4 of Pina 2009.
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "culling/baselines/random.h"
#include "culling/bqr_tree.h"
#include "culling/object_table.h"

namespace manzana::culling::test {

using baselines::Random;

struct City {
  std::vector<BlockVolume> blocks;
  std::vector<std::vector<BoxD>> objects;  ///< of each block
  double width = 0;                        ///< metres, centred at `center`
  Vec3d center{0, 0, 0};
};

/// side x side blocks at a pitch of 100 m, `per_block` objects each on average: 2 buildings of 5 objects, else trees.
inline City make_city(int side, int per_block, std::uint64_t seed, const Vec3d& center = Vec3d(0)) {
  City city{{}, {}, side * 100.0, center};
  Random random(seed);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const Vec3d corner =
          center + Vec3d{(x - side / 2.0) * 100 + random.in(-8, 8), (y - side / 2.0) * 100 + random.in(-8, 8), 0};
      std::vector<BoxD> objects;
      BoxD box{corner + Vec3d(0, 0, 0), corner + Vec3d(100, 100, 4)};  // the ground and the cars on the half-streets
      for (int i = 0; i < per_block; ++i) {
        const bool building = i % 5 < 2;
        const Vec3d half = building ? Vec3d{random.in(4, 14), random.in(4, 14), random.in(4, 30)}
                                    : Vec3d{random.in(1, 4), 0, random.in(2, 8)};
        const Vec3d size{half.x, building ? half.y : half.x, half.z};
        const Vec3d middle = corner + Vec3d{random.in(14, 86), random.in(14, 86), size.z};
        objects.push_back({middle - size, middle + size});
        box = merge(box, objects.back());
      }
      city.blocks.push_back({Vec2d(corner) + 50.0, box, enclosing_sphere(box)});
      city.objects.push_back(std::move(objects));
    }
  return city;
}

/// The objects of a city in the order of its tree.
struct Ordered {
  std::vector<BoxD> boxes;
  std::vector<std::uint32_t> first{0};
};
inline Ordered ordered_objects(const City& city, const BqrTree& tree) {
  Ordered all;
  for (const std::uint32_t block : tree.order) {
    all.boxes.insert(all.boxes.end(), city.objects[block].begin(), city.objects[block].end());
    all.first.push_back(static_cast<std::uint32_t>(all.boxes.size()));
  }
  return all;
}

/// Frame t of [0, 1] of the flight: along the ground from outside to the heart, up above the roofs turning down, and
/// diagonally to the ground.
inline View pina_view(const City& city, double t) {
  const double out = 0.6 * city.width;
  const auto view = [&](const Vec3d& at, double heading, double pitch) {
    const Vec3d forward{std::sin(heading) * std::cos(pitch), std::cos(heading) * std::cos(pitch), std::sin(pitch)};
    return look(city.center + at, forward, Vec3d(0, 0, 1), std::numbers::pi / 3, 16.0 / 9.0);
  };
  const double wander = 0.3 * std::sin(20 * t);
  if (t < 0.4) return view({5.0, -out + out * t / 0.4, 1.7}, wander, 0);
  if (t < 0.6) return view({5.0, 0.0, 1.7 + 120 * (t - 0.4) / 0.2}, wander, -1.2 * (t - 0.4) / 0.2);
  const double u = (t - 0.6) / 0.4;
  return view({5.0 + 0.4 * city.width * u, 0.4 * city.width * u, 121.7 - 118 * u}, 0.785 + wander, -1.2 + 1.1 * u);
}

}  // namespace manzana::culling::test

#include "scenegraph/draw/car_model.h"

#include <catch2/catch.hpp>
#include <set>

#include "scenegraph/draw/car_layer.h"

namespace manzana::draw {

TEST_CASE("cars stand on their wheels, within the radius that culling gives them") {
  for (std::size_t body = 0; body < kCarBodies; ++body) {
    for (std::size_t level = 0; level < kCarLevels; ++level) {
      INFO("body " << body << ", level " << level);
      const CarMesh mesh = make_car(static_cast<CarBody>(body), level);
      float lowest = 1, highest = 0, farthest = 0;
      for (const CarVertex& v : mesh.vertices) {
        lowest = std::min(lowest, v.position.z);
        highest = std::max(highest, v.position.z);
        farthest = std::max(farthest, glm::length(v.position));
      }
      CHECK(lowest >= -1e-6F);
      CHECK(lowest < 0.2F);
      CHECK(highest > 1.3F);
      CHECK(highest < 1.9F);
      CHECK(static_cast<double>(farthest) <= kCarRadius);
    }
  }
}

TEST_CASE("each level of a car has a fraction of the triangles of the one before") {
  for (std::size_t body = 0; body < kCarBodies; ++body) {
    std::array<std::size_t, kCarLevels> triangles{};
    for (std::size_t level = 0; level < kCarLevels; ++level) {
      triangles[level] = make_car(static_cast<CarBody>(body), level).indices.size() / 3;
    }
    INFO(triangles[0] << " " << triangles[1] << " " << triangles[2] << " " << triangles[3]);
    CHECK((triangles[0] >= 400 && triangles[0] <= 1700));
    CHECK((triangles[1] >= 150 && triangles[1] <= 320));
    CHECK((triangles[2] >= 40 && triangles[2] <= 100));
    CHECK(triangles[3] == 18);
  }
}

TEST_CASE("car faces look outwards: the signed volume is that of a car") {
  for (std::size_t body = 0; body < kCarBodies; ++body) {
    for (std::size_t level = 0; level < kCarLevels; ++level) {
      INFO("body " << body << ", level " << level);
      const CarMesh mesh = make_car(static_cast<CarBody>(body), level);
      double volume = 0;
      const Vec3d middle(0, 0, 0.24);  // the open bottom adds nothing from here
      for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const auto p = [&](std::size_t k) { return Vec3d(mesh.vertices[mesh.indices[i + k]].position) - middle; };
        volume += glm::dot(p(0), glm::cross(p(1), p(2))) / 6;
      }
      CHECK(volume > 4);
      CHECK(volume < 13);
    }
  }
}

TEST_CASE("paints and bodies vary, and depend on the car alone") {
  std::set<float> reds;
  std::set<CarBody> bodies;
  for (std::uint32_t car = 0; car < 300; ++car) {
    reds.insert(car_paint(car).r);
    bodies.insert(car_body(car));
    CHECK(car_paint(car) == car_paint(car));
  }
  CHECK(reds.size() >= 8);
  CHECK(bodies.size() == kCarBodies);
}

TEST_CASE("a car is placed along its way, upright") {
  CarState car;
  car.position = {1e6, 5, 7};
  car.forward = glm::normalize(Vec3d(1, 1, 0.1));
  const Instance instance = place_car(car, {0, 0, 1}, {1e6, 0, 0});
  const Vec3 nose = placed(instance.rows, {0, 2, 0}), roof = placed(instance.rows, {0, 0, 1});
  CHECK(glm::distance(Vec3d(nose), Vec3d(0, 5, 7) + 2.0 * car.forward) < 1e-5);
  CHECK(roof.z > 7.9F);
}

}  // namespace manzana::draw

#include "apps/walkthrough/builtin_paths.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "apps/walkthrough/obstacles.h"
#include "apps/walkthrough/street_walk.h"
#include "apps/walkthrough/survey.h"
#include "scenegraph/import/import.h"
#include "tests/support/data.h"

using namespace manzana;
using namespace manzana::walkthrough;

namespace {

const Scene& town() {
  static const Imported city = import_city("builtin:town", {}, {});
  return city.scene;
}

double distance_to_segment(const Vec2d& p, const Vec2d& a, const Vec2d& b) {
  const double length2 = glm::dot(b - a, b - a);
  const double s = length2 > 0 ? glm::clamp(glm::dot(p - a, b - a) / length2, 0.0, 1.0) : 0.0;
  return glm::distance(p, a + (b - a) * s);
}

double nearest_lane(const Scene& scene, const Vec2d& place) {
  double nearest = 1e9;
  for (const HalfStreet& half : scene.traffic.halves)
    for (std::uint32_t i = half.first_point; i + 1 < half.last_point; ++i)
      nearest = std::min(nearest, distance_to_segment(place, Vec2d(scene.traffic.points[i].position),
                                                      Vec2d(scene.traffic.points[i + 1].position)));
  return nearest;
}

/// Of the road's surface above ground, at the lane's point nearest to a place: bridges and ramps rise.
double road_height(const Scene& scene, const Vec2d& place) {
  const auto nearer = [&](const LanePoint& a, const LanePoint& b) {
    return glm::distance(Vec2d(a.position), place) < glm::distance(Vec2d(b.position), place);
  };
  const auto& points = scene.traffic.points;
  return to_ground(scene.frame, std::min_element(points.begin(), points.end(), nearer)->position).z;
}

std::vector<CameraPose> poses(const CameraPath& path, int n) {
  std::vector<CameraPose> out;
  for (int i = 0; i < n; ++i) out.push_back(pose_at(path, path.begin() + path.duration() * i / (n - 1)));
  return out;
}

bool finite(const CameraPose& pose) {
  return std::isfinite(glm::dot(pose.eye, pose.look)) && glm::distance(pose.eye, pose.look) > 0.1;
}

/// Angle between upward and the look, degrees; 90 is level.
double tilt(const CameraPose& pose) {
  const Vec3d d = pose.look - pose.eye;
  return glm::degrees(std::atan2(std::hypot(d.x, d.y), d.z));
}

}  // namespace

TEST_CASE("built-in paths: on the ground the eye is outside of buildings, 600 places of each path") {
  const Obstacles obstacles(town());
  for (const char* name : {"tour", "pina"}) {
    const CameraPath path = builtin_path(name, town());
    CHECK(path.name == name);
    int inside = 0, street_level = 0;
    Vec3d where(0, 0, 0);
    for (const CameraPose& pose : poses(path, 600)) {
      REQUIRE(finite(pose));
      REQUIRE(pose.eye.z > 1);
      if (obstacles.inside_building(pose.eye)) ++inside, where = pose.eye;
      street_level += pose.eye.z < 3 ? 1 : 0;
    }
    CAPTURE(name, where.x, where.y, where.z);
    CHECK(inside == 0);
    CHECK(street_level > 60);
  }
}

TEST_CASE("built-in paths: pina is the source's path") {
  const Scene& scene = town();
  const Survey survey = survey_city(scene);
  const auto frames = poses(pina_path(scene), 300);
  // Outside at ground level, looking to the town.
  CHECK(frames[0].eye.z == Approx(1.7));
  CHECK(glm::distance(Vec2d(frames[0].eye), survey.center) > survey.radius);
  CHECK(glm::dot(Vec2d(frames[0].look - frames[0].eye), survey.center - Vec2d(frames[0].eye)) > 0);
  // Walks to the heart.
  for (std::size_t i = 0; i <= 47; ++i) CHECK(frames[i].eye.z < 10);
  CHECK(glm::distance(Vec2d(frames[48].eye), survey.heart) < 150);
  // Rises straight up, and turns down.
  for (std::size_t i = 49; i < 140; ++i) {
    CHECK(glm::distance(Vec2d(frames[i].eye), Vec2d(frames[48].eye)) < 5);
    CHECK(frames[i].eye.z >= frames[i - 1].eye.z - 1e-9);
  }
  CHECK(frames[140].eye.z > Obstacles(scene).highest_roof(Vec2d(frames[140].eye), Vec2d(frames[140].eye), 300));
  CHECK(tilt(frames[140]) > 100);
  // Comes down diagonally, and looks at the ground at the end.
  for (std::size_t i = 141; i < 300; ++i) CHECK(frames[i].eye.z <= frames[i - 1].eye.z + 1e-9);
  CHECK(frames[299].eye.z == Approx(1.7));
  CHECK(glm::distance(Vec2d(frames[299].eye), Vec2d(frames[140].eye)) > 100);
  CHECK(tilt(frames[299]) > 100);
}

TEST_CASE("built-in paths: the tour begins on a street, sees wood and river, and ends above the town") {
  const Scene& scene = town();
  const Survey survey = survey_city(scene);
  REQUIRE(survey.wood);
  REQUIRE(survey.river.size() >= 3);
  const auto frames = poses(tour_path(scene), 900);
  CHECK(frames[0].eye.z == Approx(1.7 + road_height(scene, Vec2d(frames[0].eye))).margin(0.2));
  CHECK(nearest_lane(scene, Vec2d(frames[0].eye)) < 5);
  double wood = 1e9, river = 1e9;
  for (const CameraPose& pose : frames) {
    wood = std::min(wood, glm::distance(Vec2d(pose.eye), *survey.wood));
    river = std::min(river, glm::distance(Vec2d(pose.eye), survey.river[survey.river.size() / 2]));
  }
  CHECK(wood < 20);
  CHECK(river < 40);
  CHECK(frames.back().eye.z > 100);
  CHECK(glm::distance(Vec2d(frames.back().look), survey.center) < survey.radius);
}

TEST_CASE("built-in paths: the same every time, and there is one for an empty scene") {
  CHECK(to_json(tour_path(town())) == to_json(tour_path(town())));
  const Scene empty;
  for (const char* name : {"tour", "pina"})
    for (const CameraPose& pose : poses(builtin_path(name, empty), 50)) CHECK(finite(pose));
}

TEST_CASE("built-in paths: real cities have both, outside of buildings while walking") {
  for (const char* name : {"osm/helsinki-centre.osm.pbf", "tiny/porto-alegre-streets.osm.pbf"}) {
    const auto file = data_file(name);
    if (!file) return;
    const Imported city = import_city(file->string(), {}, {});
    const Obstacles obstacles(city.scene);
    for (const char* kind : {"tour", "pina"}) {
      int inside = 0, walking = 0;
      for (const CameraPose& pose : poses(builtin_path(kind, city.scene), 600)) {
        REQUIRE(finite(pose));
        walking += pose.eye.z < 3 ? 1 : 0;
        inside += pose.eye.z < 3 && obstacles.inside_building(pose.eye) ? 1 : 0;
      }
      CAPTURE(name, kind, inside, walking);
      CHECK(walking > 60);
      CHECK(inside * 20 <= walking);  // streets run through gates, and an extract may have no clear way in
    }
  }
}

TEST_CASE("obstacles: a building's box corner is not its inside, its middle is, nothing is inside above the roof") {
  const Scene& scene = town();
  const Obstacles obstacles(scene);
  const LayerTable& t = scene.buildings.table;
  int middles = 0;
  for (std::uint32_t i = 0; i < t.size(); i += 50) {
    const Vec3d min = scene.tree.origin + Vec3d(t.boxes[i].min);
    const Vec3d max = scene.tree.origin + Vec3d(t.boxes[i].max);
    const Vec3d middle = to_ground(scene.frame, Vec3d(Vec2d(min + max) / 2.0, min.z + 1));
    middles += obstacles.inside_building(middle) ? 1 : 0;
    CHECK_FALSE(obstacles.inside_building(middle + Vec3d(0, 0, max.z - min.z + 1)));
    CHECK(obstacles.highest_roof(Vec2d(middle), Vec2d(middle), 0.5) >= max.z - min.z - 0.5);
  }
  CHECK(middles * 10 > static_cast<int>(t.size() / 50) * 8);  // courtyards and L shapes are not filled in the middle
}

TEST_CASE("walking: a route is connected and follows lanes, and resampling keeps ends and steps") {
  const Scene& scene = town();
  const StreetSearch search(scene.traffic, {0, 0});
  const Obstacles obstacles(scene);
  const auto feet = walk_along(scene, obstacles, straight_routes(search, 3000, 1).front(), 8);
  REQUIRE(feet.size() > 20);
  for (std::size_t i = 1; i < feet.size(); ++i) {
    CHECK(glm::distance(feet[i], feet[i - 1]) < 13);
    CHECK(nearest_lane(scene, Vec2d(feet[i])) < 14);
  }
  const std::vector<Vec3d> corner{{0, 0, 0}, {10, 0, 0}, {10, 7, 0}};
  const auto points = resample(corner, 2);
  CHECK(points.front() == corner.front());
  CHECK(points.back() == corner.back());
  CHECK(points.size() == 9);
  CHECK(glm::distance(points[6], Vec3d(10, 2, 0)) < 1e-9);
  CHECK(resample({}, 1).empty());
}

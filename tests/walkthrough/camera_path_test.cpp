#include "apps/walkthrough/camera_path.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/support/temporary_folder.h"

using namespace manzana;
using namespace manzana::walkthrough;

namespace {

CameraPath random_path(std::mt19937_64& bits) {
  const auto unit = [&] { return static_cast<double>(bits() >> 11) * 0x1p-53; };
  CameraPath path{"random", {}};
  double t = unit() * 10 - 5;
  for (int i = 0; i < 12; ++i, t += 0.01 + unit() * 10) {
    const Vec3d eye(unit() * 2000, unit() * 2000, unit() * 100);
    path.keys.push_back({t, {eye, eye + Vec3d(1 + unit(), unit(), unit())}});
  }
  return path;
}

std::string error_of(const std::string& json) {
  try {
    parse_path(json, "p.json");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("camera path: goes through its keys, stands still beyond them") {
  std::mt19937_64 bits(1);
  const CameraPath path = random_path(bits);
  for (const CameraKey& key : path.keys) {
    CHECK(glm::distance(pose_at(path, key.t).eye, key.pose.eye) < 1e-9);
    CHECK(glm::distance(pose_at(path, key.t).look, key.pose.look) < 1e-9);
  }
  CHECK(pose_at(path, path.begin() - 100).eye == path.keys.front().pose.eye);
  CHECK(pose_at(path, path.begin() + path.duration() + 100).eye == path.keys.back().pose.eye);
}

TEST_CASE("camera path: never leaves the box of the two keys next to it, so never dives under the ground") {
  std::mt19937_64 bits(2);
  for (int round = 0; round < 20; ++round) {
    const CameraPath path = random_path(bits);
    for (std::size_t i = 0; i + 1 < path.keys.size(); ++i)
      for (int j = 0; j <= 32; ++j) {
        const CameraKey &a = path.keys[i], &b = path.keys[i + 1];
        const Vec3d eye = pose_at(path, a.t + (b.t - a.t) * j / 32).eye;
        for (int axis = 0; axis < 3; ++axis) {
          REQUIRE(eye[axis] >= std::min(a.pose.eye[axis], b.pose.eye[axis]));
          REQUIRE(eye[axis] <= std::max(a.pose.eye[axis], b.pose.eye[axis]));
        }
      }
  }
}

TEST_CASE("camera path: place and speed are continuous over keys") {
  std::mt19937_64 bits(3);
  const CameraPath path = random_path(bits);
  constexpr double h = 1e-6;
  for (std::size_t i = 1; i + 1 < path.keys.size(); ++i) {
    const double t = path.keys[i].t;
    const Vec3d before = pose_at(path, t - h).eye, at = pose_at(path, t).eye, after = pose_at(path, t + h).eye;
    const double speed = glm::length(at - before) / h;
    CHECK(glm::length((after - at) - (at - before)) / h < 1e-2 * (1 + speed));
  }
}

TEST_CASE("camera path: straight and even keys give straight and even motion") {
  CameraPath path{"line", {}};
  for (int i = 0; i < 5; ++i) path.keys.push_back({i * 2.0, {{i * 10.0, i * -3.0, 5}, {i * 10.0 + 1, i * -3.0, 5}}});
  for (double t = 0; t <= 8; t += 0.1) CHECK(glm::distance(pose_at(path, t).eye, Vec3d(t * 5, t * -1.5, 5)) < 1e-9);
}

TEST_CASE("camera path: where the look passes through the eye there still is a direction") {
  const CameraPath path{"through", {{0, {{0, 0, 1}, {10, 0, 1}}}, {1, {{0, 0, 1}, {-10, 0, 1}}}}};
  const CameraPose pose = pose_at(path, 0.5);
  CHECK(glm::distance(pose.eye, pose.look) > 0.1);
}

TEST_CASE("camera path: JSON and back gives the same path") {
  std::mt19937_64 bits(4);
  const CameraPath path = random_path(bits), again = parse_path(to_json(path), "again");
  REQUIRE(again.keys.size() == path.keys.size());
  CHECK(again.name == path.name);
  for (std::size_t i = 0; i < path.keys.size(); ++i) {
    CHECK(again.keys[i].t == path.keys[i].t);
    CHECK(again.keys[i].pose.eye == path.keys[i].pose.eye);
    CHECK(again.keys[i].pose.look == path.keys[i].pose.look);
  }
}

TEST_CASE("camera path: a wrong file is told with the place") {
  const std::string good = R"({"t":0,"eye":[0,0,2],"look":[0,9,2]})";
  CHECK(error_of("{").find("p.json: parse error at line 1") == 0);
  CHECK(error_of("[]") == "p.json: an object is needed");
  CHECK(error_of("{}") == "p.json: \"keys\" is missing");
  CHECK(error_of(R"({"keys":[]})") == "p.json: keys: at least one key is needed");
  CHECK(error_of(R"({"keys":7})") == "p.json: keys: at least one key is needed");
  CHECK(error_of(R"({"keys":[7]})") == "p.json: keys[0]: an object is needed");
  CHECK(error_of(R"({"keys":[)" + good + R"(,{"t":1,"eye":[0,0],"look":[0,0,1]}]})") ==
        "p.json: keys[1].eye: three numbers are needed");
  CHECK(error_of(R"({"keys":[{"t":0,"eye":[0,0,2],"look":[0,"x",2]}]})") ==
        "p.json: keys[0].look[1]: a number is needed");
  CHECK(error_of(R"({"keys":[{"t":0,"eye":[0,0,2]}]})") == "p.json: keys[0]: \"look\" is missing");
  CHECK(error_of(R"({"keys":[)" + good + "," + good + "]}") == "p.json: keys[1].t: must be later than the key before");
  CHECK(error_of(R"({"keys":[{"t":0,"eye":[0,0,2],"look":[0,0,2]}]})") ==
        "p.json: keys[0]: eye and look are the same point");
  CHECK(error_of(R"({"keys":[{"t":0,"eye":[1e300,0,2],"look":[0,0,2]}]})") ==
        "p.json: keys[0].eye[0]: a number within 1000000 is needed");
  CHECK(error_of(R"({"keys":[{"t":1e999,"eye":[0,0,2],"look":[0,1,2]}]})") != "no error");
}

TEST_CASE("camera path: a missing file, and a folder") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(read_path(folder.path() / "none.json"), Catch::Contains("none.json: no such camera path"));
  CHECK_THROWS_WITH(read_path(folder.path()), Catch::Contains("is a folder"));
}

TEST_CASE("camera path: the paths of data/paths can be read") {
  int paths = 0;
  for (const auto& entry : std::filesystem::directory_iterator(MANZANA_PATHS)) {
    CHECK(read_path(entry.path()).duration() > 0);
    ++paths;
  }
  CHECK(paths >= 1);
}

TEST_CASE("camera path: ground coordinates and back, far from the anchor and high up") {
  std::mt19937_64 bits(5);
  const auto unit = [&] { return static_cast<double>(bits() >> 11) * 0x1p-53; };
  for (const double lat : {0.0, 60.0, 89.9, -90.0}) {
    const LocalFrame frame({lat, 179.99, 0});
    for (int i = 0; i < 100; ++i) {
      const double reach = std::pow(10, unit() * 5);
      const Vec3d p((unit() - 0.5) * reach, (unit() - 0.5) * reach, unit() * 5000);
      CHECK(glm::distance(to_ground(frame, from_ground(frame, p)), p) < 1e-3);
    }
  }
}

TEST_CASE("camera path: the view stands upright on the ground below it") {
  const LocalFrame frame({48, 11, 0});
  const Vec3d eye(40000, -30000, 100);
  const auto view = view_of(frame, {eye, eye + Vec3d(100, 50, -20)}, 2.0);
  const Vec3d up = frame.up_at({eye.x, eye.y});
  CHECK(std::abs(glm::dot(view.right, up)) < 1e-12);
  CHECK(glm::dot(view.up, up) > 0.9);
  CHECK(glm::distance(view.eye, from_ground(frame, eye)) < 1e-9);
  CHECK(view.tan_top == Approx(std::tan(glm::radians(30.0))));
  CHECK(view.tan_right == Approx(2 * std::tan(glm::radians(30.0))));
}

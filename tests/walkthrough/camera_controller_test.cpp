#include "apps/walkthrough/camera_controller.h"

#include <catch2/catch.hpp>
#include <numbers>

using namespace manzana;
using namespace manzana::walkthrough;

namespace {

const CameraPath kPath{"p", {{2, {{0, 0, 50}, {0, 10, 50}}}, {4, {{100, 0, 50}, {100, 10, 50}}}}};

}  // namespace

TEST_CASE("camera: walking north, east, and faster") {
  const Scene scene;
  Camera camera;
  steer(camera, scene, kPath, {.move = {0, 1, 0}, .turn = {0, 0}}, 1, 0);
  CHECK(camera.eye.y == Approx(4));
  CHECK(camera.eye.x == Approx(0).margin(1e-9));
  camera = {};
  steer(camera, scene, kPath, {.move = {0, 1, 0}, .turn = {std::numbers::pi / 2, 0}, .run = true}, 1, 0);
  CHECK(camera.eye.x == Approx(16));
  CHECK(camera.eye.y == Approx(0).margin(1e-9));
}

TEST_CASE("camera: a walker stays on the ground, whatever the keys say") {
  const Scene scene;
  Camera camera;
  camera.eye.z = 100;
  for (int i = 0; i < 300; ++i) steer(camera, scene, kPath, {.move = {0.3, 1, 1}, .turn = {0.01, 0.02}}, 1.0 / 60, 0);
  CHECK(camera.eye.z == Approx(1.7));
}

TEST_CASE("camera: flying goes where it looks, stops above the ground, and the wheel changes its speed") {
  const Scene scene;
  Camera camera;
  camera.mode = Mode::fly;
  camera.eye.z = 100;
  camera.pitch = -0.5;
  steer(camera, scene, kPath, {.move = {0, 1, 0}, .turn = {0, 0}}, 1, 0);
  CHECK(camera.eye.y == Approx(30 * std::cos(0.5)));
  CHECK(camera.eye.z == Approx(100 - 30 * std::sin(0.5)));
  for (int i = 0; i < 20; ++i) steer(camera, scene, kPath, {.move = {0, 1, -1}, .turn = {0, 0}, .wheel = 1}, 1, 0);
  CHECK(camera.eye.z > 0);
  CHECK(camera.fly_speed > 300);
}

TEST_CASE("camera: looking straight up is stopped short of turning over") {
  const Scene scene;
  Camera camera;
  steer(camera, scene, kPath, {.turn = {0, 100}}, 0.01, 0);
  CHECK(camera.pitch < std::numbers::pi / 2);
  CHECK(camera.pitch > 1.5);
}

TEST_CASE("camera: stands where it is told and looks where it is told, also far from the anchor") {
  const LocalFrame frame({-33, 151, 0});
  for (const Vec3d eye : {Vec3d(0, 0, 1.7), Vec3d(90000, 50000, 300)}) {
    Camera camera;
    const CameraPose pose{eye, eye + Vec3d(30, -40, 5)};
    stand_at(camera, frame, pose);
    const auto wanted = view_of(frame, pose, 1.5), got = view_of(frame, pose_of(camera, frame), 1.5);
    CHECK(glm::distance(wanted.eye, got.eye) < 1e-6);
    CHECK(glm::distance(wanted.forward, got.forward) < 1e-6);
    CHECK(glm::distance(wanted.up, got.up) < 1e-6);
  }
}

TEST_CASE("camera: the path plays from its beginning, ends by itself, and a step leaves it") {
  const Scene scene;
  Camera camera;
  toggle_path(camera, kPath);
  steer(camera, scene, kPath, {}, 1, 0);
  CHECK(camera.mode == Mode::path);
  CHECK(camera.eye.x == Approx(50));
  steer(camera, scene, kPath, {}, 5, 0);
  CHECK(camera.mode == Mode::fly);
  CHECK(camera.eye.x == Approx(100));
  toggle_path(camera, kPath);
  steer(camera, scene, kPath, {.move = {0, 1, 0}, .turn = {0, 0}}, 0.001, 0);
  CHECK(camera.mode == Mode::fly);
  CHECK(camera.eye.x == Approx(0).margin(1));
}

TEST_CASE("camera: without cars there is nothing to drive") {
  const Scene scene;
  Camera camera;
  toggle_drive(camera, scene, 0);
  CHECK(camera.mode == Mode::walk);
}

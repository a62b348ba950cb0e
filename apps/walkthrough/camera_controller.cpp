#include "apps/walkthrough/camera_controller.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace manzana::walkthrough {
namespace {

constexpr double kEye = 1.7;          // metres above the ground, on foot
constexpr double kWalkSpeed = 4;      // metres a second: brisk, as in games
constexpr double kRun = 4;            // times as fast
constexpr double kLowest = 0.3;       // metres, of a flight
constexpr double kHighest = 50000;    // metres
constexpr double kSteepest = 1.55;    // radians: short of straight up, where there is no forward
constexpr double kStartFlying = 3;    // metres: standing higher than this is flying
constexpr double kFarthest = 500000;  // metres from the anchor

Mat3d axes_at(const LocalFrame& frame, const Vec3d& eye) { return block_frame(frame, {eye.x, eye.y}).axes; }

Vec3d forward_of(const Camera& camera) {
  const double level = std::cos(camera.pitch);
  return {std::sin(camera.yaw) * level, std::cos(camera.yaw) * level, std::sin(camera.pitch)};
}

void turn(Camera& camera, const Vec2d& by) {
  camera.yaw = std::remainder(camera.yaw + by.x, 2 * std::numbers::pi);
  camera.pitch = std::clamp(camera.pitch + by.y, -kSteepest, kSteepest);
}

/// `step` in the axes of the ground below: right and forward along the ground, up.
void go(Camera& camera, const LocalFrame& frame, const Vec3d& step) {
  const Vec3d in_l = axes_at(frame, camera.eye) * Vec3d(step.x, step.y, 0);
  camera.eye += Vec3d(in_l.x, in_l.y, step.z);
  for (int axis = 0; axis < 2; ++axis) camera.eye[axis] = std::clamp(camera.eye[axis], -kFarthest, kFarthest);
}

void walk(Camera& camera, const LocalFrame& frame, const Steering& steering, double dt) {
  const double speed = kWalkSpeed * (steering.run ? kRun : 1) * dt;
  const double s = std::sin(camera.yaw), c = std::cos(camera.yaw);
  const Vec3d& m = steering.move;
  go(camera, frame, Vec3d(c * m.x + s * m.y, c * m.y - s * m.x, 0) * speed);
  camera.eye.z += (kEye - camera.eye.z) * (1 - std::exp(-8 * dt));  // comes down to earth within half a second
}

void fly(Camera& camera, const LocalFrame& frame, const Steering& steering, double dt) {
  camera.fly_speed = std::clamp(camera.fly_speed * std::pow(1.2, steering.wheel), 1.0, 2000.0);
  const double speed = camera.fly_speed * (steering.run ? kRun : 1) * dt;
  const Vec3d right(std::cos(camera.yaw), -std::sin(camera.yaw), 0), up(0, 0, 1);
  const Vec3d& m = steering.move;
  go(camera, frame, (right * m.x + forward_of(camera) * m.y + up * m.z) * speed);
  camera.eye.z = std::clamp(camera.eye.z, kLowest, kHighest);
}

/// Behind the car and a little above it.
void drive(Camera& camera, const Scene& scene, std::uint64_t tick, double dt) {
  constexpr double kBehind = 7.5, kAbove = 2.8, kQuick = 5;
  const CarState car = car_at(scene.traffic, camera.car, tick);
  const Vec3d mixed = glm::mix(camera.car_heading, car.forward, 1 - std::exp(-kQuick * dt));
  camera.car_heading = glm::length(mixed) > 1e-3 ? glm::normalize(mixed) : car.forward;
  camera.eye = to_ground(scene.frame, car.position - camera.car_heading * kBehind);
  camera.eye.z += kAbove;
  const Vec3d ahead = glm::transpose(axes_at(scene.frame, camera.eye)) * camera.car_heading;
  camera.yaw = std::atan2(ahead.x, ahead.y);
  camera.pitch = -0.12;
}

void play(Camera& camera, const Scene& scene, const CameraPath& path, double dt) {
  camera.path_t += dt;
  const Mode mode = camera.mode;
  stand_at(camera, scene.frame, pose_at(path, camera.path_t));
  if (camera.path_t < path.begin() + path.duration()) camera.mode = mode;
}

}  // namespace

void steer(Camera& camera, const Scene& scene, const CameraPath& path, const Steering& steering, double dt,
           std::uint64_t tick) {
  const bool moves = steering.move != Vec3d(0, 0, 0);
  if (moves && camera.mode == Mode::path) stand_at(camera, scene.frame, pose_at(path, camera.path_t));
  turn(camera, steering.turn);
  switch (camera.mode) {
    case Mode::walk:
      return walk(camera, scene.frame, steering, dt);
    case Mode::fly:
      return fly(camera, scene.frame, steering, dt);
    case Mode::drive:
      return drive(camera, scene, tick, dt);
    case Mode::path:
      return play(camera, scene, path, dt);
  }
}

CameraPose pose_of(const Camera& camera, const LocalFrame& frame) {
  constexpr double kLookAt = 20;  // metres ahead
  const Vec3d forward = axes_at(frame, camera.eye) * forward_of(camera);
  return {camera.eye, to_ground(frame, from_ground(frame, camera.eye) + forward * kLookAt)};
}

void stand_at(Camera& camera, const LocalFrame& frame, const CameraPose& pose) {
  camera.eye = pose.eye;
  const Vec3d d =
      glm::transpose(axes_at(frame, pose.eye)) * (from_ground(frame, pose.look) - from_ground(frame, pose.eye));
  camera.yaw = std::atan2(d.x, d.y);
  camera.pitch = std::clamp(std::atan2(d.z, std::hypot(d.x, d.y)), -kSteepest, kSteepest);
  camera.mode = camera.eye.z > kStartFlying ? Mode::fly : Mode::walk;
}

void toggle_drive(Camera& camera, const Scene& scene, std::uint64_t tick) {
  if (camera.mode == Mode::drive) {
    camera.mode = Mode::walk;
    return;
  }
  const Vec3d eye = from_ground(scene.frame, camera.eye);
  double nearest = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < scene.traffic.cars(); ++i) {
    const CarState car = car_at(scene.traffic, i, tick);
    const double distance = glm::distance(car.position, eye);
    if (distance >= nearest) continue;
    nearest = distance;
    camera.mode = Mode::drive;
    camera.car = i;
    camera.car_heading = car.forward;
  }
}

void toggle_fly(Camera& camera) { camera.mode = camera.mode == Mode::fly ? Mode::walk : Mode::fly; }

void toggle_path(Camera& camera, const CameraPath& path) {
  if (camera.mode == Mode::path) {
    camera.mode = Mode::fly;
    return;
  }
  camera.mode = Mode::path;
  camera.path_t = path.begin();
}

}  // namespace manzana::walkthrough

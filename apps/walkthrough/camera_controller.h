#pragma once
/// The camera of the window: on foot, flying, behind a car, or on a recorded path.
///   steer(camera, scene, path, steering, dt, tick);          // once a frame
///   View view = view_of(scene.frame, pose_of(camera, scene.frame), aspect);
#include <cstdint>

#include "apps/walkthrough/camera_path.h"
#include "scenegraph/scene.h"

namespace manzana::walkthrough {

enum class Mode : std::uint8_t { walk, fly, drive, path };

/// What keys and mouse say in one frame.
struct Steering {
  Vec3d move{0, 0, 0};  ///< right, forward, up; each -1 to 1
  Vec2d turn{0, 0};     ///< radians to the right and up
  bool run = false;
  double wheel = 0;  ///< notches; flying gets faster or slower by them
};

struct Camera {
  Mode mode = Mode::walk;
  Vec3d eye{0, 0, 1.7};        ///< x, y, height above ground
  double yaw = 0, pitch = 0;   ///< radians, from the north of the ground below to the right, and up
  double fly_speed = 30;       ///< metres a second
  std::uint32_t car = 0;       ///< while driving: the car that is followed
  Vec3d car_heading{0, 1, 0};  ///< its direction, smoothed
  double path_t = 0;           ///< while on the path
};

void steer(Camera& camera, const Scene& scene, const CameraPath& path, const Steering& steering, double dt,
           std::uint64_t tick);

CameraPose pose_of(const Camera& camera, const LocalFrame& frame);

/// Stands there and looks that way, on foot near the ground, flying above it.
void stand_at(Camera& camera, const LocalFrame& frame, const CameraPose& pose);

/// Gets into the nearest car, or out of the one it is in; nothing without cars. O(cars log half-streets).
void toggle_drive(Camera& camera, const Scene& scene, std::uint64_t tick);
void toggle_fly(Camera& camera);
/// Starts the path from its beginning, or leaves it where it is.
void toggle_path(Camera& camera, const CameraPath& path);

}  // namespace manzana::walkthrough

#pragma once
/// Where the camera is at a time, as JSON:
///   {"name": "over the roofs", "keys": [{"t": 0, "eye": [0, -400, 60], "look": [0, 0, 10]}, ...]}
/// t in seconds, rising; eye and look (the point looked at) are (x, y in the plan of L, metres above ground).
///   CameraPath path = read_path("roofs.json");
///   View view = view_of(scene.frame, pose_at(path, 12.5), 16.0 / 9.0);
/// Between keys each coordinate is a monotone cubic: smooth (C1), through every key, and never beyond the two keys next
/// to it, so a path whose keys are above ground stays above ground.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "culling/frustum.h"
#include "scenegraph/local_frame.h"

namespace manzana::walkthrough {

inline constexpr double kFovyDeg = 60;
inline constexpr double kNear = 0.2;  // metres; nearer things are cut away

struct CameraPose {
  Vec3d eye{0, 0, 0}, look{0, 1, 0};  ///< x, y, height above ground
};
struct CameraKey {
  double t = 0;  ///< seconds
  CameraPose pose;
};
struct CameraPath {
  std::string name;
  std::vector<CameraKey> keys;  ///< at least one; t rises, eye and look of a key differ
  double begin() const { return keys.front().t; }
  double duration() const { return keys.back().t - keys.front().t; }
};

/// Closed form in t: any time can be asked for, before the first and after the last key stands still.
/// [Fritsch, Butland: A Method for Constructing Local Monotone Piecewise Cubic Interpolants, SISC 5(2), 1984]
CameraPose pose_at(const CameraPath& path, double t);

/// `where` begins the message of std::runtime_error: "FILE: keys[3].eye: three numbers are needed".
CameraPath parse_path(std::string_view json, const std::string& where);
CameraPath read_path(const std::filesystem::path& file);
std::string to_json(const CameraPath& path);

/// Between (x, y, height above ground) and L. Both ways within a millimetre to 1000 km.
Vec3d from_ground(const LocalFrame& frame, const Vec3d& plan_and_height);
Vec3d to_ground(const LocalFrame& frame, const Vec3d& local);

/// Up is the ground's up below the eye. The far plane is infinite.
culling::View view_of(const LocalFrame& frame, const CameraPose& pose, double aspect);

}  // namespace manzana::walkthrough

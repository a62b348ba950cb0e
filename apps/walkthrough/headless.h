#pragma once
/// The walkthrough without a window: a camera path drawn to files.
#include <span>

#include "apps/walkthrough/camera_path.h"
#include "apps/walkthrough/options.h"
#include "foliage/prepared_plant.h"
#include "scenegraph/import/import.h"

namespace manzana::walkthrough {

/// Time on the path of frame i of n: the first frame begins it, the last ends it.
inline double path_time(const CameraPath& path, int frame, int frames) {
  return frames > 1 ? path.begin() + path.duration() * frame / (frames - 1) : path.begin();
}
/// Scene time: the cars go on at 30 frames a second, whatever the path's speed.
inline constexpr double kFramesPerSecond = 30;

/// Draws through EGL and writes, whole or not at all, into options.out: frame_NNNN.png (every K-th), frames.csv,
/// summary.json, issues.txt. The first frame is drawn once before, unmeasured, so that no row holds the building of
/// shaders. Throws std::runtime_error when there is no GL 4.5 or a file cannot be written.
void run_headless(const Options& options, const Imported& city, std::span<const foliage::PreparedPlant> plants,
                  const CameraPath& path);

}  // namespace manzana::walkthrough

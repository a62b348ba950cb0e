#pragma once
/// Records where the camera is as a path that can be replayed.
#include <filesystem>

#include "apps/walkthrough/camera_path.h"

namespace manzana::walkthrough {

/// The first of FOLDER/prefix001suffix, ...002... that does not exist.
std::filesystem::path free_name(const std::filesystem::path& folder, const std::string& prefix,
                                const std::string& suffix);

class Recorder {
 public:
  bool on() const { return on_; }
  void start(double now);
  /// Keeps a key five times a second while it is on.
  void take(double now, const CameraPose& pose);
  /// Writes FOLDER/path-NNN.json and says where. Throws std::runtime_error when it cannot be written.
  std::filesystem::path stop(const std::filesystem::path& folder);

 private:
  bool on_ = false;
  double start_ = 0;
  CameraPath path_;
};

}  // namespace manzana::walkthrough

#pragma once
/// --hours: whether a long day of driving leaves anything behind. Cars are counted in all blocks, not in those in
/// view; bytes of the device are what the renderer holds, those of the host what the system says of the process.
///   Endurance day;
///   ...each frame: day.see(scene, seconds, device_bytes, lap);
///   std::printf("%s", to_text(day).c_str()); if (auto what = drift(day)) throw std::runtime_error(*what);
#include <optional>
#include <string>
#include <vector>

#include "scenegraph/scene.h"

namespace manzana::walkthrough {

struct Endurance {
  struct Row {
    double hours = 0;
    std::uint64_t cars = 0;
    double device_mb = 0, host_mb = 0;
    int lap = 0;  ///< of the camera's path: what the first one brings is no drift
  };
  std::uint64_t cars = 0;  ///< of the scene
  std::vector<Row> rows;
  std::vector<CarState> found = {};  ///< at one time; kept, so that counting adds nothing to the bytes that it measures
  void see(const Scene& scene, double seconds, std::size_t device_bytes, int lap);
};

/// Some dozen rows.
std::string to_text(const Endurance& day);

/// What did not stay: a car too many or too few at any time; after the first two laps any byte of the device, or more
/// of the host than 2 MB and a hundredth.
std::optional<std::string> drift(const Endurance& day);

}  // namespace manzana::walkthrough

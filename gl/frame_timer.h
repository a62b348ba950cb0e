#pragma once
/// How long the GPU works on each frame, known some frames later, without waiting. Means nothing on software renderers,
/// which put work off beyond the query.
///   FrameTimer timer;
///   timer.begin(); ...draw...; timer.end();
///   if (timer.newest_ms() > 0) ...
#include <array>

#include "gl/handle.h"

namespace manzana::gl {

class FrameTimer {
 public:
  FrameTimer();
  /// Frames that find all queries under way are not timed.
  void begin();
  void end();
  double newest_ms();  ///< 0 before the first has arrived

 private:
  static constexpr std::size_t kSlots = 4;
  void collect();

  std::array<Query, kSlots> queries_;
  std::array<bool, kSlots> pending_{};
  std::size_t next_ = 0;
  bool timing_ = false;
  double newest_ms_ = 0;
};

}  // namespace manzana::gl

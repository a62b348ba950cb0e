#pragma once
/// A few bytes that the GPU writes each frame, read some frames later without waiting.
///   Readback counts(16);
///   counts.copy(buffer, offset);                          // each frame, after what writes them
///   if (const std::byte* bytes = counts.newest()) ...     // of the newest frame that is done
#include <array>
#include <cstddef>

#include "gl/handle.h"

namespace manzana::gl {

class Readback {
 public:
  explicit Readback(std::size_t bytes);
  ~Readback();
  Readback(const Readback&) = delete;
  Readback& operator=(const Readback&) = delete;

  /// When the GPU is more than three frames behind, this frame is left out.
  void copy(const Buffer& from, GLintptr offset);
  /// nullptr before the first has arrived. After glFinish: the last copied.
  const std::byte* newest();

 private:
  static constexpr std::size_t kSlots = 4;
  void collect();

  std::size_t bytes_;
  Buffer buffer_;
  const std::byte* memory_ = nullptr;
  std::array<GLsync, kSlots> fences_{};
  std::size_t next_ = 0, newest_ = kSlots;
};

}  // namespace manzana::gl

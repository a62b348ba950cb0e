#pragma once
/// Buffers that are filled bit by bit, so that no frame waits for a whole city.
///   Uploads uploads;
///   Buffer vertices = uploads.make(bytes_that_stay);
///   while (uploads.left() > 0) { uploads.step(8 << 20); ...a frame... }
#include <deque>
#include <span>

#include "gl/buffer.h"

namespace manzana::gl {

class Uploads {
 public:
  /// `content` must stay until it is uploaded, and the buffer must live until then. Throws as make_buffer does.
  Buffer make(std::span<const std::byte> content);
  /// At most so many bytes, in the order of make().
  void step(std::size_t most_bytes);
  std::size_t left() const { return left_; }

 private:
  struct Part {
    GLuint buffer;
    std::span<const std::byte> content;
    std::size_t done;
  };
  std::deque<Part> parts_;
  std::size_t left_ = 0;
};

}  // namespace manzana::gl

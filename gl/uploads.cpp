#include "gl/uploads.h"

#include <algorithm>

namespace manzana::gl {

Buffer Uploads::make(std::span<const std::byte> content) {
  Buffer buffer = make_writable_buffer(content.size());
  if (!content.empty()) parts_.push_back({buffer.name(), content, 0});
  left_ += content.size();
  return buffer;
}

void Uploads::step(std::size_t most_bytes) {
  while (most_bytes > 0 && !parts_.empty()) {
    Part& part = parts_.front();
    const std::size_t n = std::min(most_bytes, part.content.size() - part.done);
    glNamedBufferSubData(part.buffer, static_cast<GLintptr>(part.done), static_cast<GLsizeiptr>(n),
                         part.content.data() + part.done);
    part.done += n;
    left_ -= n;
    most_bytes -= n;
    if (part.done == part.content.size()) parts_.pop_front();
  }
}

}  // namespace manzana::gl

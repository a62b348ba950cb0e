#pragma once
/// Lists that are streamed anew each frame, bound for shaders.
#include <algorithm>
#include <vector>

#include "gl/buffer.h"

namespace manzana::foliage {

/// For StreamBuffer::begin.
template <class T>
std::size_t room_for(const std::vector<T>& list) {
  return gl::StreamBuffer::padded(std::max<std::size_t>(list.size(), 1) * sizeof(T));
}

template <class T>
void bind_list(gl::StreamBuffer& stream, GLuint binding, const std::vector<T>& list) {
  const std::size_t n = std::max<std::size_t>(list.size(), 1);
  const auto room = stream.take<T>(n);
  std::copy(list.begin(), list.end(), room.items);
  glBindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, stream.name(), room.offset,
                    static_cast<GLsizeiptr>(n * sizeof(T)));
}

}  // namespace manzana::foliage

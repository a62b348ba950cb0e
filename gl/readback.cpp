#include "gl/readback.h"

#include <stdexcept>

namespace manzana::gl {

Readback::Readback(std::size_t bytes) : bytes_(bytes) {
  constexpr GLbitfield kFlags = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
  const auto size = static_cast<GLsizeiptr>(bytes * kSlots);
  GLuint name = 0;
  glCreateBuffers(1, &name);
  buffer_ = Buffer(name);
  glNamedBufferStorage(name, size, nullptr, kFlags);
  memory_ = static_cast<const std::byte*>(glMapNamedBufferRange(name, 0, size, kFlags));
  if (memory_ == nullptr) throw std::runtime_error("the device does not map buffers for good");
}

Readback::~Readback() {
  if (LostContext::any()) return;
  for (const GLsync fence : fences_) glDeleteSync(fence);
  glUnmapNamedBuffer(buffer_.name());
}

void Readback::copy(const Buffer& from, GLintptr offset) {
  collect();
  if (fences_[next_] != nullptr) return;
  glCopyNamedBufferSubData(from.name(), buffer_.name(), offset, static_cast<GLintptr>(next_ * bytes_),
                           static_cast<GLsizeiptr>(bytes_));
  fences_[next_] = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  next_ = (next_ + 1) % kSlots;
}

void Readback::collect() {
  for (std::size_t i = 0; i < kSlots; ++i) {
    const std::size_t slot = (next_ + i) % kSlots;  // oldest first
    if (fences_[slot] == nullptr) continue;
    if (glClientWaitSync(fences_[slot], 0, 0) == GL_TIMEOUT_EXPIRED) return;
    glDeleteSync(fences_[slot]);
    fences_[slot] = nullptr;
    newest_ = slot;
  }
}

const std::byte* Readback::newest() {
  collect();
  return newest_ == kSlots ? nullptr : memory_ + newest_ * bytes_;
}

}  // namespace manzana::gl

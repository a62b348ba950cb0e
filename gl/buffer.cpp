#include "gl/buffer.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>
#include <string>

namespace manzana::gl {
namespace {

Buffer make_storage(std::size_t bytes, const void* content, GLbitfield flags) {
  GLuint name = 0;
  glCreateBuffers(1, &name);
  Buffer buffer(name);
  glNamedBufferStorage(name, static_cast<GLsizeiptr>(bytes), content, flags);
  GLint64 size = 0;
  glGetNamedBufferParameteri64v(name, GL_BUFFER_SIZE, &size);
  if (static_cast<std::size_t>(size) != bytes) {
    throw std::runtime_error("the device has no room for a buffer of " + std::to_string(bytes) + " bytes");
  }
  return buffer;
}

void wait_for(GLsync& fence) {
  if (fence == nullptr) return;
  constexpr GLuint64 kSecond = 1'000'000'000;
  while (glClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, kSecond) == GL_TIMEOUT_EXPIRED) {
  }
  glDeleteSync(fence);
  fence = nullptr;
}

}  // namespace

Buffer make_buffer(std::span<const std::byte> content) {
  constexpr std::size_t kLeast = 16;
  if (content.size() < kLeast) {
    std::array<std::byte, kLeast> padded{};
    std::copy(content.begin(), content.end(), padded.begin());
    return make_storage(kLeast, padded.data(), 0);
  }
  return make_storage(content.size(), content.data(), 0);
}

Buffer make_writable_buffer(std::size_t bytes) {
  return make_storage(std::max<std::size_t>(bytes, 16), nullptr, GL_DYNAMIC_STORAGE_BIT);
}

std::size_t bytes_of(const Buffer& buffer) {
  GLint64 size = 0;
  if (buffer.name() != 0) glGetNamedBufferParameteri64v(buffer.name(), GL_BUFFER_SIZE, &size);
  return static_cast<std::size_t>(size);
}

Buffer make_buffer(std::size_t bytes) {
  Buffer buffer = make_writable_buffer(bytes);
  glClearNamedBufferData(buffer.name(), GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE, nullptr);
  return buffer;
}

StreamBuffer::~StreamBuffer() { release(); }

void StreamBuffer::release() {
  if (LostContext::any()) return;
  for (GLsync& fence : fences_) wait_for(fence);
  if (memory_ != nullptr) glUnmapNamedBuffer(buffer_.name());
  memory_ = nullptr;
}

void StreamBuffer::allocate(std::size_t bytes) {
  release();
  third_ = padded(bytes);
  constexpr GLbitfield kFlags = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
  buffer_ = make_storage(third_ * kThirds, nullptr, kFlags);
  memory_ = static_cast<std::byte*>(
      glMapNamedBufferRange(buffer_.name(), 0, static_cast<GLsizeiptr>(third_ * kThirds), kFlags));
  if (memory_ == nullptr) throw std::runtime_error("the device does not map buffers for good");
}

void StreamBuffer::begin(std::size_t bytes) {
  if (bytes > third_) allocate(std::max(bytes, third_ + third_ / 2));
  current_ = (current_ + 1) % kThirds;
  used_ = 0;
  wait_for(fences_[current_]);
}

std::size_t StreamBuffer::reserve(std::size_t bytes) {
  const std::size_t at = current_ * third_ + used_;
  used_ += padded(bytes);
  assert(used_ <= third_);
  return at;
}

void StreamBuffer::end() { fences_[current_] = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0); }

}  // namespace manzana::gl

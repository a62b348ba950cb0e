#pragma once
/// Buffers: those that are filled once, and one that is filled anew each frame without waiting for the GPU.
///   Buffer vertices = make_buffer(std::as_bytes(std::span(mesh.vertices)));
///   StreamBuffer stream;
///   stream.begin(bytes_of_this_frame);
///   auto [items, offset] = stream.take<Item>(n);   // write items[0..n), bind the range from offset
///   ...draw...
///   stream.end();
#include <array>
#include <cstddef>
#include <span>

#include "gl/handle.h"

namespace manzana::gl {

/// An immutable buffer with that content; of at least 16 bytes, so that an empty one can be bound.
/// Throws std::runtime_error when the device has no room.
Buffer make_buffer(std::span<const std::byte> content);
/// Zeros, written by the GPU or by glNamedBufferSubData.
Buffer make_buffer(std::size_t bytes);
/// The same, of any content.
Buffer make_writable_buffer(std::size_t bytes);
std::size_t bytes_of(const Buffer& buffer);

/// One of DrawElementsIndirectCommand's rows, as GL lays it out.
struct DrawCommand {
  GLuint count = 0, instances = 1, first_index = 0;
  GLint base_vertex = 0;
  GLuint base_instance = 0;
};

/// Three frames' worth of memory, mapped for as long as it lives; a fence guards each third.
class StreamBuffer {
 public:
  StreamBuffer() = default;
  ~StreamBuffer();
  StreamBuffer(const StreamBuffer&) = delete;
  StreamBuffer& operator=(const StreamBuffer&) = delete;

  /// Opens the next third; waits only when the GPU is three frames behind. Grows, with a wait, when a frame needs more
  /// than any before it, so a steady view allocates nothing.
  void begin(std::size_t bytes);
  /// Room for n items, on the boundary that uniform and storage ranges ask for. Asserts that begin() had enough bytes.
  template <class T>
  struct Taken {
    T* items;
    GLintptr offset;
  };
  template <class T>
  Taken<T> take(std::size_t n) {
    const std::size_t at = reserve(n * sizeof(T));
    return {static_cast<T*>(static_cast<void*>(memory_ + at)), static_cast<GLintptr>(at)};
  }
  void end();
  GLuint name() const { return buffer_.name(); }
  std::size_t bytes() const { return kThirds * third_; }
  /// What `take` of so many bytes may use up, for the sum that begin() wants.
  static std::size_t padded(std::size_t bytes) { return (bytes + kAlignment - 1) / kAlignment * kAlignment; }

 private:
  static constexpr std::size_t kAlignment = 256;  // no device asks for more
  static constexpr std::size_t kThirds = 3;
  std::size_t reserve(std::size_t bytes);
  void allocate(std::size_t bytes);
  void release();

  Buffer buffer_;
  std::byte* memory_ = nullptr;
  std::size_t third_ = 0, current_ = 0, used_ = 0;
  std::array<GLsync, kThirds> fences_{};
};

}  // namespace manzana::gl

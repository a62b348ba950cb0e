// Apart from those who count: compiled together, new and malloc would be taken for a mismatch.
#include "tests/culling/allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> allocated{0};

void* counted(std::size_t size, std::size_t alignment) {
  ++allocated;
  const std::size_t whole = (size / alignment + 1) * alignment;
  return alignment > alignof(std::max_align_t) ? std::aligned_alloc(alignment, whole) : std::malloc(whole);
}
void* or_throw(void* p) {
  if (p == nullptr) throw std::bad_alloc();
  return p;
}

}  // namespace

std::size_t allocations() { return allocated; }

void* operator new(std::size_t size) { return or_throw(counted(size, 1)); }
void* operator new(std::size_t size, std::align_val_t a) {
  return or_throw(counted(size, static_cast<std::size_t>(a)));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return counted(size, 1); }
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

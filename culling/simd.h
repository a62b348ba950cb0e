#pragma once
/// Four floats at once: SSE2, which every x86-64 has, and a twin in plain C++ for the rest. Nobody else includes an
/// intrinsics header. Comparisons with NaN are false in both; minimum and maximum answer `b` when either is NaN.
#include <array>
#include <cmath>
#include <cstddef>

#if defined(__SSE2__) && !defined(MANZANA_SCALAR)
#include <emmintrin.h>
#define MANZANA_SSE2 1
#endif

namespace manzana::culling {

#ifdef MANZANA_SSE2

struct Float4 {
  __m128 v;
};
inline Float4 splat(float x) { return {_mm_set1_ps(x)}; }
inline Float4 load(const float* x) { return {_mm_loadu_ps(x)}; }
inline Float4 operator+(Float4 a, Float4 b) { return {_mm_add_ps(a.v, b.v)}; }
inline Float4 operator*(Float4 a, Float4 b) { return {_mm_mul_ps(a.v, b.v)}; }
inline Float4 operator-(Float4 a) { return {_mm_xor_ps(a.v, _mm_set1_ps(-0.0F))}; }
inline Float4 abs(Float4 a) { return {_mm_andnot_ps(_mm_set1_ps(-0.0F), a.v)}; }
inline Float4 minimum(Float4 a, Float4 b) { return {_mm_min_ps(a.v, b.v)}; }
inline Float4 maximum(Float4 a, Float4 b) { return {_mm_max_ps(a.v, b.v)}; }
/// Bit i: lane i of a is less than lane i of b.
inline unsigned less(Float4 a, Float4 b) { return static_cast<unsigned>(_mm_movemask_ps(_mm_cmplt_ps(a.v, b.v))); }

#else

struct Float4 {
  std::array<float, 4> v;
};
template <class F>
Float4 each_lane(F f) {
  return {{f(0), f(1), f(2), f(3)}};
}
inline Float4 splat(float x) { return {{x, x, x, x}}; }
inline Float4 load(const float* x) { return {{x[0], x[1], x[2], x[3]}}; }
inline Float4 operator+(Float4 a, Float4 b) {
  return each_lane([&](std::size_t i) { return a.v[i] + b.v[i]; });
}
inline Float4 operator*(Float4 a, Float4 b) {
  return each_lane([&](std::size_t i) { return a.v[i] * b.v[i]; });
}
inline Float4 operator-(Float4 a) {
  return each_lane([&](std::size_t i) { return -a.v[i]; });
}
inline Float4 abs(Float4 a) {
  return each_lane([&](std::size_t i) { return std::abs(a.v[i]); });
}
inline Float4 minimum(Float4 a, Float4 b) {
  return each_lane([&](std::size_t i) { return a.v[i] < b.v[i] ? a.v[i] : b.v[i]; });
}
inline Float4 maximum(Float4 a, Float4 b) {
  return each_lane([&](std::size_t i) { return a.v[i] > b.v[i] ? a.v[i] : b.v[i]; });
}
/// Bit i: lane i of a is less than lane i of b.
inline unsigned less(Float4 a, Float4 b) {
  unsigned bits = 0;
  for (std::size_t i = 0; i < 4; ++i) bits |= a.v[i] < b.v[i] ? 1U << i : 0U;
  return bits;
}

#endif

}  // namespace manzana::culling

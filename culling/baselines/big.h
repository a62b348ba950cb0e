#pragma once
/// Vectors of fifty digits, for oracles: sums and products of doubles keep every bit that matters.
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "culling/vec.h"

namespace manzana::culling {

using Big = boost::multiprecision::cpp_bin_float_50;

struct Big3 {
  Big x, y, z;
};
inline Big3 big(const Vec3d& v) { return {Big(v.x), Big(v.y), Big(v.z)}; }
inline Vec3d to_double(const Big3& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

inline Big3 operator+(const Big3& a, const Big3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Big3 operator-(const Big3& a, const Big3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Big3 operator*(const Big& s, const Big3& v) { return {s * v.x, s * v.y, s * v.z}; }
inline Big dot(const Big3& a, const Big3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Big3 cross(const Big3& a, const Big3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Big length(const Big3& v) { return sqrt(dot(v, v)); }
inline Big3 unit(const Big3& v) { return (1 / length(v)) * v; }

/// Half-space dot(normal, p) + offset >= 0; unit normal.
struct BigPlane {
  Big3 normal;
  Big offset;
};

}  // namespace manzana::culling

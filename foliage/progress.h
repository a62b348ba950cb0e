#pragma once
/// How much of a piece of work is done, told as it goes on.
#include <functional>

namespace manzana::foliage {

/// Called with [0, 1], not falling, by one thread at a time; may be empty.
using Progress = std::function<void(double)>;

/// Of work that is the part [first, last] of all.
inline Progress part_of(const Progress& progress, double first, double last) {
  if (!progress) return {};
  return [progress, first, last](double done) { progress(first + (last - first) * done); };
}

inline void tell(const Progress& progress, double done) {
  if (progress) progress(done);
}

/// That `done` of `all` like pieces are.
inline void tell(const Progress& progress, std::size_t done, std::size_t all) {
  tell(progress, static_cast<double>(done) / static_cast<double>(all));
}

}  // namespace manzana::foliage

#pragma once
/// The clock that everything is timed by.
#include <chrono>

namespace manzana::apps {

using Clock = std::chrono::steady_clock;

inline double us_since(Clock::time_point start) {
  return std::chrono::duration<double, std::micro>(Clock::now() - start).count();
}

}  // namespace manzana::apps

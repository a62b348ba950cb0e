#include <algorithm>
#include <array>
#include <numbers>

#include "culling/baselines/cases.h"

namespace manzana::baselines {
namespace {

/// Where the camera is at t, which way it heads (radians from east to north), and how far up it looks.
struct Stop {
  double t;
  Vec2d at;  ///< of half the width and half the depth of what is flown over
  double height_m, heading, pitch;
};

/// The five legs between them: along the outskirts, the walk in, the climb, the turn down, the dive.
constexpr std::array kStops{
    Stop{0.00, {-1.35, -0.40}, 1.7, 0.04, 0.0}, Stop{0.10, {-1.00, 0.02}, 1.7, 0.04, 0.0},
    Stop{0.19, {0.32, 0.02}, 1.7, 0.04, 0.0},   Stop{0.50, {0.32, 0.02}, 75, 0.04, 0.0},
    Stop{0.60, {0.32, 0.02}, 75, 0.57, -1.24},  Stop{1.00, {0.95, 0.85}, 1.7, 0.57, -0.2},
};

Stop between(const Stop& a, const Stop& b, double t) {
  const double u = (t - a.t) / (b.t - a.t);
  const auto mix = [u](double x, double y) { return x + (y - x) * u; };
  return {t, a.at + (b.at - a.at) * u, mix(a.height_m, b.height_m), mix(a.heading, b.heading), mix(a.pitch, b.pitch)};
}

Stop stop_at(double t) {
  const auto* next = std::find_if(kStops.begin() + 1, kStops.end() - 1, [t](const Stop& s) { return t <= s.t; });
  return between(next[-1], *next, t);
}

}  // namespace

culling::View flight(const City& city, double far_m, double t) {
  const Stop stop = stop_at(t);
  const culling::BoxD& below = city.flown.empty() ? city.bounds : city.flown;
  const Vec3d middle = culling::center(below), half = (below.max - below.min) / 2.0;
  const Vec3d eye{middle.x + stop.at.x * half.x, middle.y + stop.at.y * half.y, below.min.z + stop.height_m};
  const Vec3d forward{std::cos(stop.heading) * std::cos(stop.pitch), std::sin(stop.heading) * std::cos(stop.pitch),
                      std::sin(stop.pitch)};
  return culling::look(eye, forward, Vec3d(0, 0, 1), std::numbers::pi / 3, 16.0 / 9.0, 0.1, far_m);
}

}  // namespace manzana::baselines

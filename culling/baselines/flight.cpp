#include <algorithm>
#include <array>
#include <numbers>

#include "culling/baselines/cases.h"

namespace manzana::baselines {
namespace {

/// Where the camera is at t, which way it heads (radians from east to north), and how far up it looks.
struct Stop {
  double t;
  Vec2d at;  ///< of the city's half-width and half-depth
  double height_m, heading, pitch;
};

constexpr double kDown = -std::numbers::pi / 2 * 0.8;

/// The five legs between them: the outskirts, the walk in, the climb, the turn down, the dive.
constexpr std::array kStops{
    Stop{0.00, {-1.2, 0.02}, 1.7, 0, 0},  Stop{0.08, {-1.0, 0.02}, 1.7, 0, 0},
    Stop{0.30, {0, 0.02}, 1.7, 0, 0},     Stop{0.60, {0, 0.02}, 150, 0, 0},
    Stop{0.70, {0, 0.02}, 150, 0, kDown}, Stop{1.00, {0.5, 0.5}, 1.7, 0.8, kDown / 2},
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
  const Vec3d middle = culling::center(city.bounds);
  const Vec3d half = (city.bounds.max - city.bounds.min) / 2.0;
  const Vec3d eye{middle.x + stop.at.x * half.x, middle.y + stop.at.y * half.y, city.bounds.min.z + stop.height_m};
  const Vec3d forward{std::cos(stop.heading) * std::cos(stop.pitch), std::sin(stop.heading) * std::cos(stop.pitch),
                      std::sin(stop.pitch)};
  return culling::look(eye, forward, Vec3d(0, 0, 1), std::numbers::pi / 3, 16.0 / 9.0, 0.1, far_m);
}

}  // namespace manzana::baselines

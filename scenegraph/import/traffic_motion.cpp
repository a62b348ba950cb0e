#include "scenegraph/import/traffic_motion.h"

#include <algorithm>
#include <cmath>

namespace manzana {
namespace {

constexpr double kNodeSpacing = 5;  // metres
constexpr int kMostNodes = 60;

double within(double speed, double distance) { return std::sqrt(speed * speed + 2 * kAcceleration * distance); }

/// Bends slow the nodes on both sides.
void limit_bends(LaneProfile& profile, const Lane& lane) {
  double s = 0;
  for (std::size_t i = 1; i + 1 < lane.line.size(); ++i) {
    s += glm::distance(Vec2d(lane.line[i - 1]), Vec2d(lane.line[i]));
    const auto node = std::min(static_cast<std::size_t>(s / profile.spacing), profile.speed.size() - 2);
    for (double* v : {&profile.speed[node], &profile.speed[node + 1]}) *v = std::min(*v, bend_speed(lane.line, i));
  }
}

double capped(const LaneProfile& profile, std::size_t i, double cruise) {
  const std::size_t last = profile.speed.size() - 1;
  const auto slowed = [&](double from, double distance) {
    return std::sqrt(std::max(0.0, from * from - 2 * kAcceleration * distance));
  };
  const double braking = slowed(profile.speed.front(), profile.spacing * double(i));
  const double leaving = slowed(profile.speed.back(), profile.spacing * double(last - i));
  return std::min(profile.speed[i], std::max({cruise, braking, leaving}));
}

}  // namespace

LaneProfile free_profile(const Lane& lane, double first, double last) {
  const int steps = std::clamp(static_cast<int>(std::ceil(lane.length / kNodeSpacing)), 1, kMostNodes);
  LaneProfile profile{lane.length / steps, std::vector<double>(static_cast<std::size_t>(steps) + 1, lane.speed)};
  limit_bends(profile, lane);
  auto& v = profile.speed;
  v.front() = first;
  v.back() = last;
  for (std::size_t i = 1; i + 1 < v.size(); ++i) v[i] = std::min(v[i], within(v[i - 1], profile.spacing));
  for (std::size_t i = v.size() - 2; i > 0; --i) v[i] = std::min(v[i], within(v[i + 1], profile.spacing));
  return profile;
}

double lane_time(const LaneProfile& profile, double cruise) {
  double sum = 0, before = capped(profile, 0, cruise);
  for (std::size_t i = 1; i < profile.speed.size(); ++i) {
    const double after = capped(profile, i, cruise);
    sum += 2 * profile.spacing / (before + after);
    before = after;
  }
  return sum;
}

double cruise_for(const LaneProfile& profile, double seconds, double slowest) {
  double low = slowest, high = *std::max_element(profile.speed.begin(), profile.speed.end());
  for (int i = 0; i < 32 && low < high; ++i) {
    const double middle = (low + high) / 2;
    (lane_time(profile, middle) > seconds ? low : high) = middle;
  }
  return high;
}

void append_pieces(std::vector<MotionPiece>& pieces, const LaneProfile& profile, double cruise, double way_speed) {
  const std::size_t first = pieces.size();
  double t = 0, v = capped(profile, 0, cruise);
  const auto add = [&](double s, double a) {
    const bool same =
        pieces.size() > first && a == 0 && pieces.back().a == 0.0f && std::abs(double(pieces.back().v0) - v) < 1e-6;
    if (!same) pieces.push_back({float(t), float(s), float(v), float(a)});
  };
  for (std::size_t i = 1; i < profile.speed.size(); ++i) {
    const double after = capped(profile, i, cruise);
    const double a = (after * after - v * v) / (2 * profile.spacing);
    add(profile.spacing * double(i - 1), a);
    t += 2 * profile.spacing / (v + after);
    v = after;
  }
  v = way_speed;
  add(profile.spacing * double(profile.speed.size() - 1), 0);
}

}  // namespace manzana

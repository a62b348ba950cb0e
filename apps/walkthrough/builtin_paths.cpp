#include "apps/walkthrough/builtin_paths.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "apps/walkthrough/street_walk.h"
#include "apps/walkthrough/survey.h"

namespace manzana::walkthrough {
namespace {

constexpr double kEye = 1.7;  // metres above the ground
constexpr double kStep = 8;   // metres between the keys of a walk
constexpr double kFarthestWalk = 3000;

/// Appends keys while time goes on.
struct Keys {
  std::vector<CameraKey> keys;
  double t = 0;
  void add(const Vec3d& eye, const Vec3d& look) { keys.push_back({t, {eye, look}}); }
  /// The next key comes `seconds` later.
  void add_after(double seconds, const Vec3d& eye, const Vec3d& look) {
    t += seconds;
    add(eye, look);
  }
  const CameraPose& last() const { return keys.back().pose; }
};

Vec3d at_height(const Vec2d& plan, double height) { return {plan, height}; }

Vec2d direction(const Vec2d& from, const Vec2d& to) {
  const double length = glm::distance(from, to);
  return length > 1e-6 ? (to - from) / length : Vec2d(0, 1);
}

/// Walks along `feet` in `seconds`, looking at what is `ahead_m` further on the way.
void walk(Keys& keys, const std::vector<Vec3d>& feet, double seconds, double ahead_m) {
  const auto ahead = static_cast<std::size_t>(ahead_m / kStep);
  const Vec2d out = direction(Vec2d(feet[feet.size() - std::min<std::size_t>(feet.size(), 4)]), Vec2d(feet.back()));
  const double stride = seconds / static_cast<double>(feet.size() - 1);
  for (std::size_t i = 0; i < feet.size(); ++i) {
    const std::size_t next = i + ahead;
    const double beyond = next < feet.size() ? 0 : kStep * static_cast<double>(next - (feet.size() - 1));
    const Vec3d look = feet[std::min(next, feet.size() - 1)] + Vec3d(out * beyond, kEye);
    const Vec3d eye = feet[i] + Vec3d(0, 0, kEye);
    i == 0 ? keys.add(eye, look) : keys.add_after(stride, eye, look);
  }
}

/// Ground outside the city from which one sees straight along `inwards` to `gate`.
Vec2d outside(const Obstacles& obstacles, const Survey& survey, const Vec2d& gate, const Vec2d& inwards) {
  const double need = survey.radius * 1.25 - glm::distance(gate, survey.center);
  const double out = std::clamp(need, 60.0, 600.0);
  for (double more = 0; more < 200; more += 10) {
    const Vec2d place = gate - inwards * (out + more);
    if (obstacles.clear(at_height(place, kEye), 5)) return place;
  }
  return gate - inwards * out;
}

/// `feet` with a straight way before it, from outside the city.
std::vector<Vec3d> from_outside(const Obstacles& obstacles, const Survey& survey, std::vector<Vec3d> feet) {
  const Vec2d gate(feet.front());
  const Vec2d inwards = direction(gate, Vec2d(feet[std::min<std::size_t>(feet.size() - 1, 6)]));
  feet.insert(feet.begin(), at_height(outside(obstacles, survey, gate, inwards), 0));
  return feet;
}

/// From outside to the heart, along streets where there are any; every kStep metres. Of the straightest ways the first
/// that comes through no building, or else the one that comes through least.
std::vector<Vec3d> way_in(const Scene& scene, const Obstacles& obstacles, const Survey& survey) {
  constexpr std::size_t kTries = 24;
  const Vec3d up(0, 0, kEye);
  std::vector<Vec3d> best{at_height(survey.heart - Vec2d(0, survey.radius), 0), at_height(survey.heart, 0)};
  double least_buried = std::numeric_limits<double>::infinity();
  for (const StreetRoute& route : straight_routes(StreetSearch(scene.traffic, survey.heart), kFarthestWalk, kTries)) {
    auto feet = walk_along(scene, obstacles, route, kStep);
    if (feet.size() < 2) continue;
    feet = from_outside(obstacles, survey, std::move(feet));
    const double buried = obstacles.buried_length(feet[0] + up, feet[1] + up);
    if (buried < least_buried) least_buried = buried, best = std::move(feet);
    if (least_buried <= 0) break;
  }
  const auto outer = resample(std::span(best).first(2), kStep);  // the streets' part has its steps already
  best.erase(best.begin(), best.begin() + 2);
  best.insert(best.begin(), outer.begin(), outer.end());
  return best;
}

/// Where a flight from `from` comes down, in a diagonal as the source has it (some 40 degrees): a street that no
/// building hides.
Vec2d landing(const Scene& scene, const Obstacles& obstacles, const Vec3d& from, const Vec2d& ahead) {
  const double nearest = 0.8 * from.z, best_distance = 1.2 * from.z, farthest = 2.5 * from.z;
  const Vec2d fallback = Vec2d(from) + ahead * best_distance;
  Vec2d best = fallback;
  double best_score = scene.traffic.halves.empty() ? 0 : 1e9;
  for (const HalfStreet& half : scene.traffic.halves) {
    const Vec2d place(scene.traffic.points[(half.first_point + half.last_point) / 2].position);
    const double distance = glm::distance(place, Vec2d(from));
    if (distance < nearest || distance > farthest) continue;
    const double turn = 1 - glm::dot(direction(Vec2d(from), place), ahead);
    const double cheap = std::abs(distance - best_distance) + 100 * turn;
    if (cheap >= best_score) continue;
    const double score = cheap + 100 * obstacles.buried_length(from, at_height(place, kEye));
    if (score < best_score) best_score = score, best = place;
  }
  return best;
}

/// Flies to `to` above all roofs on the way, looking along the way and down.
void fly(Keys& keys, const Obstacles& obstacles, const Vec3d& to, double metres_a_second) {
  const Vec3d from = keys.last().eye;
  const Vec2d a(from), b(to);
  const double distance = glm::distance(a, b);
  const double height = std::max({from.z, to.z, obstacles.highest_roof(a, b, 40) + 12});
  const double seconds = std::clamp(distance / metres_a_second, 4.0, 20.0);
  const Vec2d along = direction(a, b);
  for (const double s : {0.25, 0.5, 0.75, 1.0}) {
    const Vec3d eye = at_height(glm::mix(a, b, s), s < 1 ? height : to.z);
    keys.add_after(seconds / 4, eye, at_height(Vec2d(eye) + along * 200.0, eye.z * 0.25));
  }
}

/// Where there are no streets: straight to the heart.
void stroll(Keys& keys, const Survey& survey, double seconds) {
  const Vec2d ahead(0, survey.radius);
  keys.add(at_height(survey.heart - 0.9 * ahead, kEye), at_height(survey.heart, kEye / 2));
  keys.add_after(seconds, at_height(survey.heart, kEye), at_height(survey.heart + ahead, kEye / 2));
}

void follow_river(Keys& keys, const Obstacles& obstacles, std::vector<Vec2d> river) {
  constexpr double kAbove = 18, kSpeed = 60;
  const Vec2d here(keys.last().eye);
  if (glm::distance(here, river.back()) < glm::distance(here, river.front())) std::reverse(river.begin(), river.end());
  fly(keys, obstacles, at_height(river.front(), 40), kSpeed);
  for (std::size_t i = 1; i < river.size(); ++i) {
    const Vec2d along = direction(river[i - 1], river[i]);
    const double clear = obstacles.highest_roof(river[i - 1], river[i], 10) + 8;
    const Vec3d eye = at_height(river[i], std::max(kAbove, clear));
    keys.add_after(glm::distance(river[i - 1], river[i]) / kSpeed, eye, at_height(river[i] + along * 180.0, 2));
  }
}

void overview(Keys& keys, const Obstacles& obstacles, const Survey& survey) {
  constexpr double kWidest = 1500;
  const double radius = std::min(survey.radius, kWidest);
  const Vec2d middle = survey.radius > kWidest ? survey.heart : survey.center;
  const Vec2d back = direction(middle, Vec2d(keys.last().eye));
  const Vec3d eye = at_height(middle + back * radius * 1.2, radius * 0.6 + std::min(30.0, radius * 0.3));
  const Vec3d look = at_height(middle, 0);
  const Vec3d from = keys.last().eye;
  const double height = std::max(from.z, obstacles.highest_roof(Vec2d(from), Vec2d(eye), 40) + 12);
  keys.add_after(5, at_height(glm::mix(Vec2d(from), Vec2d(eye), 0.35), std::max(height, glm::mix(from.z, eye.z, 0.4))),
                 look);
  keys.add_after(7, eye, look);
  keys.add_after(2, eye, look);
}

}  // namespace

CameraPath pina_path(const Scene& scene) {
  constexpr double kSeconds = 120, kWalk = kSeconds * 48 / 300, kRise = kSeconds * 140 / 300 - kWalk,
                   kFly = kSeconds - kWalk - kRise, kLookDown = kSeconds * 20 / 300;
  const Survey survey = survey_city(scene);
  const Obstacles obstacles(scene);
  Keys keys;
  walk(keys, way_in(scene, obstacles, survey), kWalk, 40);
  const Vec2d heart(keys.last().eye), ahead = direction(heart, Vec2d(keys.last().look));
  const double top = std::max(80.0, obstacles.highest_roof(heart, heart, 300) + 40);
  const Vec2d down = landing(scene, obstacles, at_height(heart, top), ahead);
  const Vec2d dive = direction(heart, down);
  keys.add_after(kRise / 2, at_height(heart, top / 2),
                 at_height(heart + direction(ahead, ahead + dive) * 100.0, top / 2 - 20));
  keys.add_after(kRise / 2, at_height(heart, top), at_height(down, 0));
  const double part = 1 - kLookDown / kFly;
  const Vec3d from = at_height(heart, top), to = at_height(down, kEye), late = glm::mix(from, to, part);
  keys.add_after(kFly - kLookDown, late, at_height(down + dive * 8.0, 0));
  keys.add_after(kLookDown, to, at_height(down + dive * 1.5, 0));
  return {"pina", std::move(keys.keys)};
}

CameraPath tour_path(const Scene& scene) {
  constexpr double kWalkLength = 800, kWalkSpeed = 14, kStroll = 12;  // metres a second; seconds
  const Survey survey = survey_city(scene);
  const Obstacles obstacles(scene);
  Keys keys;
  const StreetSearch search(scene.traffic, survey.heart);
  const auto feet = walk_along(scene, obstacles, route_of_length(search, kWalkLength), kStep);
  if (feet.size() >= 2)
    walk(keys, feet, kStep * static_cast<double>(feet.size()) / kWalkSpeed, 40);
  else
    stroll(keys, survey, kStroll);
  const Vec2d heart(keys.last().eye), ahead = direction(heart, Vec2d(keys.last().look));
  const double top = obstacles.highest_roof(heart, heart, 150) + std::min(25.0, survey.radius);
  keys.add_after(7, at_height(heart, top), at_height(heart + ahead * 150.0, top * 0.3));
  if (survey.wood) fly(keys, obstacles, at_height(*survey.wood, 45), 50);
  if (!survey.river.empty()) follow_river(keys, obstacles, survey.river);
  overview(keys, obstacles, survey);
  return {"tour", std::move(keys.keys)};
}

bool is_builtin_path(const std::string& name) { return name == "tour" || name == "pina"; }

CameraPath builtin_path(const std::string& name, const Scene& scene) {
  assert(is_builtin_path(name));
  return name == "pina" ? pina_path(scene) : tour_path(scene);
}

}  // namespace manzana::walkthrough

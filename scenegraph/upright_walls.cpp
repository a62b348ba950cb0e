#include "scenegraph/upright_walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

namespace manzana {
namespace {

constexpr float kFlat = 1e-3F;   // metres that corners may be off a wall's plane
constexpr float kSteep = 0.1F;   // |z| of a normal over what lies level of it, at most
constexpr float kTouch = 1e-4F;  // metres that floats may leave between triangles one above the other
constexpr float kLow = 0.05F;    // metres: walls that are lower are none
constexpr float kSameHeight = 0.02F;
constexpr float kSameWay = 1e-2F;  // radians between normals of one plane
constexpr float kInfinity = std::numeric_limits<float>::infinity();

float cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }
bool before(const Vec2& p, const Vec2& q) { return p.x != q.x ? p.x < q.x : p.y < q.y; }

/// In its block's frame.
struct Triangle {
  std::array<Vec3, 3> p;
  Vec2 out{0, 0};             ///< its normal in plan
  float width = 0, turn = 0;  ///< metres in plan; the angle of `out`
};

/// None of those that lean.
std::optional<Triangle> upright(const std::array<Vec3, 3>& p) {
  const Vec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
  const float level = glm::length(Vec2(normal));
  if (!(level > 0) || std::abs(normal.z) > kSteep * level) return {};
  Triangle t{p, Vec2(normal) / level};
  float near = 0, far = 0, left = 0, right = 0;
  for (const Vec3& q : p) {
    const Vec2 d(q - p[0]);
    near = std::min(near, glm::dot(t.out, d)), far = std::max(far, glm::dot(t.out, d));
    left = std::min(left, cross(t.out, d)), right = std::max(right, cross(t.out, d));
  }
  t.width = right - left;
  t.turn = std::atan2(t.out.y, t.out.x);
  return far - near <= kFlat ? std::optional(t) : std::nullopt;
}

/// From the left end of a strip to the right one.
struct Heights {
  float left = 0, right = 0;
  float lower() const { return std::min(left, right); }
  bool under(const Heights& h, float by = 0) const { return left <= h.left + by && right <= h.right + by; }
};

/// What a triangle covers of a strip.
struct Part {
  Heights low, high;
};

/// Triangles of one plane, as strips.
class Plane {
 public:
  Plane(const Mat3d& axes, std::vector<UprightWall>& walls) : axes_(axes), walls_(walls) {}

  void lay(std::span<const Triangle> triangles) {
    const Triangle& widest = *std::ranges::max_element(triangles, {}, &Triangle::width);
    along_ = {-widest.out.y, widest.out.x};
    find_places(triangles);
    measure_slack(triangles, widest);
    first_ = walls_.size();
    for (std::uint32_t i = 0; i + 1 < places_.size(); ++i) lay_strip(i);
  }

 private:
  /// Corners one above the other.
  struct Place {
    float s = 0;  ///< metres along the plane
    Vec2 at{0, 0};
  };
  struct Corner {
    std::uint32_t place = 0;
    float z = 0;
  };
  using Flat = std::array<Corner, 3>;

  void find_places(std::span<const Triangle> triangles) {
    all_.clear();
    for (const Triangle& t : triangles)
      for (const Vec3& p : t.p) all_.push_back({glm::dot(along_, Vec2(p)), Vec2(p)});
    std::ranges::sort(all_, {}, &Place::s);
    places_.clear();
    for (const Place& p : all_)
      if (places_.empty() || p.s - places_.back().s > kFlat)
        places_.push_back(p);
      else if (before(p.at, places_.back().at))
        places_.back().at = p.at;  // the same one from whichever side
    flat_.clear();
    for (const Triangle& t : triangles) flat_.push_back({corner(t.p[0]), corner(t.p[1]), corner(t.p[2])});
  }
  Corner corner(const Vec3& p) const {
    const auto above = std::ranges::upper_bound(places_, glm::dot(along_, Vec2(p)), {}, &Place::s);
    return {static_cast<std::uint32_t>(above - places_.begin() - 1), p.z};
  }

  void measure_slack(std::span<const Triangle> triangles, const Triangle& widest) {
    slack_ = 0;
    for (const Triangle& t : triangles)
      for (const Vec3& p : t.p)
        slack_ = std::max({slack_, std::abs(glm::dot(widest.out, Vec2(p - widest.p[0]))),
                           glm::length(Vec2(p) - places_[corner(p).place].at)});
  }

  /// Lowest and highest at a place that the triangle reaches.
  std::array<float, 2> heights(const Flat& t, std::uint32_t place) const {
    std::array<float, 2> range{kInfinity, -kInfinity};
    const auto meet = [&](float z) { range = {std::min(range[0], z), std::max(range[1], z)}; };
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner &p = t[k], &q = t[(k + 1) % 3];
      if (p.place == place) meet(p.z);
      if (std::min(p.place, q.place) >= place || std::max(p.place, q.place) <= place) continue;
      const float part = (places_[place].s - places_[p.place].s) / (places_[q.place].s - places_[p.place].s);
      meet(p.z + part * (q.z - p.z));
    }
    return range;
  }

  /// From place i to the next.
  void lay_strip(std::uint32_t i) {
    parts_.clear();
    for (const Flat& t : flat_) {
      const auto [first, last] = std::minmax({t[0].place, t[1].place, t[2].place});
      if (first > i || last <= i) continue;
      const auto left = heights(t, i), right = heights(t, i + 1);
      parts_.push_back({{left[0], right[0]}, {left[1], right[1]}});
    }
    std::ranges::sort(parts_, {}, [](const Part& p) { return p.low.left + p.low.right; });
    for (std::size_t k = 0; k < parts_.size();) {
      Part all = parts_[k++];
      for (; k < parts_.size() && parts_[k].low.under(all.high, kTouch); ++k) raise(all.high, parts_[k].high);
      put(i, std::max(all.low.left, all.low.right), all.high.lower());
    }
  }
  /// Of two upper sides that cross one counts.
  static void raise(Heights& high, const Heights& other) {
    if (high.under(other) || (!other.under(high) && other.lower() > high.lower())) high = other;
  }

  void put(std::uint32_t i, float bottom, float top) {
    if (top - bottom < kLow) return;
    const Vec3d a(places_[i].at, 0), b(places_[i + 1].at, 0);
    const auto height = [&](const Vec3d& p, float z) { return static_cast<float>((axes_ * (p + Vec3d(0, 0, z))).z); };
    const UprightWall wall{Vec2(axes_ * a), Vec2(axes_ * b), std::max(height(a, bottom), height(b, bottom)),
                           std::min(height(a, top), height(b, top)), slack_};
    if (walls_.size() == first_ || !goes_on(walls_.back(), wall)) return walls_.push_back(wall);
    UprightWall& last = walls_.back();
    last = {last.a, wall.b, std::max(last.bottom, wall.bottom), std::min(last.top, wall.top), slack_};
  }
  static bool goes_on(const UprightWall& wall, const UprightWall& next) {
    return wall.b == next.a && std::abs(wall.bottom - next.bottom) < kSameHeight &&
           std::abs(wall.top - next.top) < kSameHeight;
  }

  const Mat3d axes_;
  std::vector<UprightWall>& walls_;
  std::size_t first_ = 0;  // of this plane's
  float slack_ = 0;
  Vec2 along_{1, 0};
  std::vector<Place> all_, places_;  // from left to right
  std::vector<Flat> flat_;
  std::vector<Part> parts_;
};

/// Those of the widest one's plane are laid, then of the widest one's that are left.
void lay_planes(std::span<Triangle> triangles, Plane& plane) {
  while (!triangles.empty()) {
    const Triangle widest = *std::ranges::max_element(triangles, {}, &Triangle::width);
    const auto in_plane = [&](const Triangle& t) {
      return std::ranges::all_of(
          t.p, [&](const Vec3& p) { return std::abs(glm::dot(widest.out, Vec2(p - widest.p[0]))) <= kFlat; });
    };
    const auto rest = std::partition(triangles.begin(), triangles.end(), in_plane);
    if (rest == triangles.begin()) return;  // no numbers
    plane.lay({triangles.begin(), rest});
    triangles = {rest, triangles.end()};
  }
}

bool is_next(const UprightWall& wall, const UprightWall& next) {
  return wall.b == next.a && wall.bottom < next.top && next.bottom < wall.top;
}

/// Walls that continue each other, one after the other.
std::vector<UprightWall> in_chains(std::vector<UprightWall> walls) {
  std::ranges::sort(walls, before, &UprightWall::a);
  const auto starting_at = [&](const Vec2& p) {
    return std::span(std::ranges::lower_bound(walls, p, before, &UprightWall::a),
                     std::ranges::upper_bound(walls, p, before, &UprightWall::a));
  };
  std::vector<bool> follows(walls.size()), used(walls.size());
  const auto number = [&](const UprightWall& w) { return static_cast<std::size_t>(&w - walls.data()); };
  for (const UprightWall& wall : walls)
    for (const UprightWall& next : starting_at(wall.b))
      if (is_next(wall, next)) follows[number(next)] = true;
  std::vector<UprightWall> chains;
  const auto follow = [&](std::size_t i) {
    for (bool joined = false; i < walls.size(); joined = true) {
      used[i] = true;
      chains.push_back(walls[i]);
      chains.back().joined = joined;
      const auto nexts = starting_at(walls[i].b);
      const auto next = std::ranges::find_if(
          nexts, [&](const UprightWall& w) { return !used[number(w)] && is_next(chains.back(), w); });
      i = next == nexts.end() ? walls.size() : number(*next);
    }
  };
  for (const bool rings : {false, true})
    for (std::size_t i = 0; i < walls.size(); ++i)
      if (!used[i] && (rings || !follows[i])) follow(i);
  return chains;
}

}  // namespace

std::vector<UprightWall> upright_walls(const Scene& scene, std::uint32_t building) {
  const MeshLayer& layer = scene.buildings;
  const std::uint32_t first = layer.index_first[building], last = layer.index_first[building + 1];
  std::vector<UprightWall> walls;
  std::vector<Triangle> all;
  for (std::uint32_t i = first; i < last; i += 3) {
    const auto p = [&](std::uint32_t k) { return layer.mesh.vertices[layer.mesh.indices[i + k]].position; };
    if (const auto t = upright({p(0), p(1), p(2)})) all.push_back(*t);
  }
  if (all.empty()) return walls;
  std::ranges::sort(all, {}, &Triangle::turn);
  Plane plane(scene.blocks[layer.mesh.vertices[layer.mesh.indices[first]].block].axes, walls);
  for (auto begin = all.begin(), end = begin; begin != all.end(); begin = end) {
    const auto turns = [](const Triangle& s, const Triangle& t) { return t.turn - s.turn > kSameWay; };
    end = std::adjacent_find(begin, all.end(), turns);
    if (end != all.end()) ++end;
    lay_planes({begin, end}, plane);
  }
  return in_chains(std::move(walls));
}

}  // namespace manzana

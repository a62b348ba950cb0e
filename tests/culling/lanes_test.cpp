// The vector tests of nodes and packets against exact signed distances, for every kind of vectors: what is called
// outside is outside, what is called inside is inside, and what is kept wrongly is a few steps off at most.
#include <cmath>
#include <iostream>

#include "culling/pack.h"
#include "tests/culling/lanes_by_target.h"
#include "tests/culling/scene.h"

namespace manzana::culling::test {
namespace {

using Real = long double;
using Vec3l = glm::vec<3, Real>;

constexpr Real kUnitSteps = 65536 / 37800.0L;  ///< 1 / k, in steps

/// A node whose lanes have known volumes, and planes that pass close to them.
struct Setting {
  BqrTree tree;
  BqrNode node;
  std::array<BoxD, kLanes> boxes;
  std::array<SphereD, kLanes> balls;
  FrustumD frustum;
  Planes planes;
};

Vec3d within(const BoxD& box, Random& random) {
  const auto part = [&] { return random.chance(0.2) ? 0.0 : random.chance(0.2) ? 1.0 : random.unit(); };
  return glm::clamp(box.min + Vec3d{part(), part(), part()} * (box.max - box.min), box.min, box.max);
}

void add_volumes(Setting& set, const BoxD& all, Random& random) {
  const double small = random.chance(0.5) ? 1 : random.scale(1e-4, 1);
  for (std::uint32_t i = 0; i < kLanes; ++i) {
    const Vec3d a = within(all, random), b = glm::mix(a, within(all, random), random.chance(0.1) ? 0 : small);
    const SphereD ball{within(all, random),
                       random.chance(0.1) ? 0 : random.scale(1e-2, 1e5) * lattice_of(set.node).step};
    set.boxes[i] = {glm::min(a, b), glm::max(a, b)};
    set.balls[i] = ball;
    set_volumes(set.node, i, set.boxes[i], ball);
  }
  set.node.lanes = set.node.blocks = 0xFFFF;
  set.node.shift = finest_shift(set.node);
}

Vec3d any_normal(Random& random) {
  Vec3d n = random.direction();
  if (random.chance(0.2)) n[static_cast<int>(random.below(3))] *= 1e-9;
  if (random.chance(0.1)) n = glm::sign(n);
  if (random.chance(0.1)) n = {0, 0, random.chance(0.5) ? 1 : -1};
  return glm::normalize(n);
}

/// Through a point of the surface of a lane's box or ball, or up to a few steps beside it.
PlaneD near_plane(const Setting& set, const Vec3d& eye, Random& random) {
  const std::size_t i = random.below(kLanes);
  const Vec3d n = any_normal(random);
  const double side = random.chance(0.5) ? 1 : -1;
  const BoxD& box = set.boxes[i];
  const Vec3d corner = glm::mix(box.min, box.max, glm::greaterThan(side * n, Vec3d(0)));
  const Vec3d point = random.chance(0.5) ? corner : set.balls[i].center + side * set.balls[i].radius * n;
  const Real beside = static_cast<Real>(lattice_of(set.node).step * random.in(-20, 20) * (random.chance(0.2) ? 0 : 1));
  return {n, static_cast<double>(beside - glm::dot(Vec3l(n), Vec3l(point) - Vec3l(eye)))};
}

/// Steps from 2^-20 m to where 1e37 m end, eyes from the middle of the lattice to 1e17 steps away.
Setting any_setting(Random& random) {
  Setting set;
  const double step = std::ldexp(1, random.chance(0.2) ? -20 : static_cast<int>(random.below(128)) - 20);
  const double farthest = std::min(random.chance(0.5) ? 65536 : 0x1p23, 2e37 / step);
  const auto corner = [&] { return std::floor(random.in(-1, 1) * farthest) * step; };
  const Lattice lattice{{corner(), corner(), corner()}, step};
  set.node = empty_node(lattice);
  set.tree.reach = glm::length(glm::max(glm::abs(lattice.corner), glm::abs(lattice.far_corner())));
  add_volumes(set, {lattice.corner, lattice.far_corner()}, random);
  set.frustum.eye = lattice.corner + 3e4 * step + random.direction() * step * random.scale(1, 1e17);
  set.frustum.count = static_cast<int>(1 + random.below(6));
  for (int k = 0; k < set.frustum.count; ++k)
    set.frustum.planes[static_cast<std::size_t>(k)] = near_plane(set, set.frustum.eye, random);
  set.planes = make_planes(set.tree, set.frustum);
  return set;
}

/// Least and greatest signed distance.
struct Span {
  Real low, high;
};
Span span(const Setting& set, std::size_t k, const Vec3d& p) {
  const PlaneD& plane = set.frustum.planes[k];
  const Real s = glm::dot(Vec3l(plane.normal), Vec3l(p) - Vec3l(set.frustum.eye)) + static_cast<Real>(plane.offset);
  return {s, s};
}
Span span(const Setting& set, std::size_t k, const BoxD& box) {
  const auto forward = glm::greaterThan(set.frustum.planes[k].normal, Vec3d(0));
  return {span(set, k, glm::mix(box.max, box.min, forward)).low,
          span(set, k, glm::mix(box.min, box.max, forward)).high};
}
Span span(const Setting& set, std::size_t k, const SphereD& ball) {
  const Real s = span(set, k, ball.center).low, r = static_cast<Real>(ball.radius);
  return {s - r, s + r};
}
Real margin(const Setting& set, std::size_t k) { return static_cast<Real>(set.planes.margin[k]); }
Real step_of(const Setting& set) { return static_cast<Real>(set.node.step); }
std::size_t planes_of(const Setting& set) { return static_cast<std::size_t>(set.frustum.count); }

void check_thresholds(const Setting& set, const NodeAnswer& answer) {
  const Lattice l = lattice_of(set.node);
  const Real k = 1 / (kUnitSteps * step_of(set));
  for (std::size_t p = 0; p < planes_of(set); ++p) {
    const auto back = glm::lessThan(set.frustum.planes[p].normal, Vec3d(0));
    const Real d = span(set, p, glm::mix(l.corner, l.far_corner(), back)).low, m = margin(set, p);
    const auto clamped = [](Real t) { return std::clamp(t, 0.0L, 65535.0L); };
    REQUIRE(answer.t_out[p] <= clamped(-k * d - 2));  // s < 0 for certain
    REQUIRE(answer.t_out[p] >= clamped(k * (-d - 2 * m) - 3.001L));
    REQUIRE(answer.t_in[p] >= clamped(-k * d + 3));  // s > 0 for certain
    REQUIRE(answer.t_in[p] <= clamped(k * (2 * m - d) + 4.001L));
  }
}

/// How far off what is kept wrongly was, in units of the coarse lattice.
struct Slack {
  Real box = 0, ball = 0, object = 0;
};

void check_lane(const Setting& set, const NodeAnswer& answer, std::size_t i, Slack& slack) {
  bool outside = false, inside = true;
  const bool alive = (answer.alive >> i & 1) != 0;
  for (std::size_t k = 0; k < planes_of(set); ++k) {
    const Span box = span(set, k, set.boxes[i]), ball = span(set, k, set.balls[i]);
    outside = outside || box.high < 0 || ball.high < 0;
    const bool in_plane = box.low > 0 || ball.low > 0;
    inside = inside && in_plane;
    if ((answer.planes[i] >> k & 1) == 0) REQUIRE(in_plane);
    if (!alive) continue;
    const Real unit = kUnitSteps * step_of(set), off = 2 * margin(set, k);
    slack.box = std::max(slack.box, (-box.high - off) / unit);
    slack.ball = std::max(slack.ball, (-ball.high - off) / unit);
  }
  if (!alive) REQUIRE(outside);
  if ((answer.inside >> i & 1) != 0) REQUIRE(inside);
}

/// t_out of the finer lattice of a block.
void check_need(const Setting& set, const NodeAnswer& answer, std::size_t i, const BoxD& frame) {
  const Real k = std::ldexp(1 / (kUnitSteps * step_of(set)), set.node.shift);
  for (std::size_t p = 0; p < planes_of(set); ++p)
    if ((answer.planes[i] >> p & 1) != 0)
      REQUIRE(answer.need[p][i] <= std::max(0.0L, -k * span(set, p, frame).low - 2));
}

/// 32 boxes of a block in lane i.
void check_objects(const Setting& set, const NodeAnswer& answer, std::size_t i, Random& random, Slack& slack) {
  const unsigned which = answer.planes[i];
  if (which == 0) return;
  const BoxD frame = lane_box(set.node, static_cast<std::uint32_t>(i));
  check_need(set, answer, i, frame);
  const double steps = std::ldexp(1 / static_cast<double>(set.node.step), set.node.shift);
  std::array<BoxD, kPacket> boxes;
  Packet packet;
  for (std::size_t j = 0; j < kPacket; ++j) {
    const Vec3d a = within(set.boxes[i], random), b = glm::mix(a, within(set.boxes[i], random), random.unit());
    boxes[j] = random.chance(0.1) ? set.boxes[i] : BoxD{glm::min(a, b), glm::max(a, b)};
    const Reaches r = reaches_of(boxes[j], frame.min, frame.max, steps);
    for (std::size_t c = 0; c < 6; ++c) packet.box[c][j] = r[c];
  }
  const std::uint32_t kept = ask_packet(set.planes, which, packet, &answer.need[0][i]);
  for (std::size_t j = 0; j < kPacket; ++j) {
    bool outside = false;
    for (std::size_t k = 0; k < planes_of(set); ++k) {
      const Real high = span(set, k, boxes[j]).high;
      outside = outside || high < 0;
      if ((kept >> j & 1) != 0 && (which >> k & 1) != 0)  // the ball may be inside the others
        slack.object = std::max(slack.object, (-high - 2 * margin(set, k)) / (kUnitSteps * step_of(set)));
    }
    if ((kept >> j & 1) == 0) REQUIRE(outside);
  }
}

TEST_CASE("what lanes say is true, and little is kept wrongly") {
  on_each_target([](const char* name) {
    Random random(31);
    Slack slack;
    std::uint64_t gone = 0, inside = 0;
    for (int trial = 0; trial < 15'000; ++trial) {
      const Setting set = any_setting(random);
      INFO("seed 31, trial " << trial);
      REQUIRE(set.planes.used == (1U << set.frustum.count) - 1);
      const NodeAnswer answer = ask_node(set.planes, set.planes.used, set.node);
      check_thresholds(set, answer);
      for (std::size_t i = 0; i < kLanes; ++i) check_lane(set, answer, i, slack);
      for (std::size_t i = 0; i < kLanes; ++i)
        if ((answer.alive >> i & 1) != 0) check_objects(set, answer, i, random, slack);
      gone += static_cast<std::uint64_t>(kLanes - std::popcount(answer.alive));
      inside += static_cast<std::uint64_t>(std::popcount(answer.inside));
    }
    std::cout << name << ": " << gone << " lanes outside, " << inside << " inside; kept wrongly, in units: boxes up to "
              << slack.box << ", balls " << slack.ball << ", objects " << slack.object << '\n';
    CHECK(gone > 10'000);
    CHECK(inside > 1000);
    CHECK(slack.box < 7.01);     // F 3, t_out 3, rounding outward 1
    CHECK(slack.ball < 8.1);     // F 3, t_out 3, R 1, the centre and its allowance 1
    CHECK(slack.object < 13.1);  // F' 3 and 1, t_out 3; F 3, its t_out 2, rounding outward 1, where shift = 0
  });
}

TEST_CASE("planes that are not finite cull nothing") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  on_each_target([&](const char*) {
    Random random(32);
    for (int trial = 0; trial < 200; ++trial) {
      Setting set = any_setting(random);
      const auto alive = [&] {
        const Planes planes = make_planes(set.tree, set.frustum);
        return ask_node(planes, planes.used, set.node).alive;
      };
      const FrustumD good = set.frustum;
      for (const double bad : {nan, inf, -inf, 1e308, -1e308}) {
        const int axis = static_cast<int>(random.below(3));
        set.frustum.eye[axis] = bad;
        CHECK(alive() == 0xFFFF);
        set.frustum = good;
        for (PlaneD& p : set.frustum.planes) p.offset = bad;
        if (bad != -1e308) CHECK(alive() == 0xFFFF);
        set.frustum = good;
        for (PlaneD& p : set.frustum.planes) p.normal[axis] = bad;
        if (!std::isfinite(bad)) CHECK(alive() == 0xFFFF);
        set.frustum = good;
      }
      set.frustum.planes.fill(kNoPlane);
      CHECK(make_planes(set.tree, set.frustum).used == 0);
    }
  });
}

}  // namespace
}  // namespace manzana::culling::test

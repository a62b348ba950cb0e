// The steps from triangles to branches: pieces, centre lines, parents, nearest branches.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "foliage/import/join_lines.h"
#include "foliage/import/nearest_branch.h"
#include "foliage/import/pieces.h"
#include "foliage/import/tube_shape.h"
#include "foliage/random.h"

using namespace manzana;
using namespace manzana::foliage;

namespace {

constexpr float kPi = 3.14159265F;

/// Positions and three corners a triangle.
struct Surface {
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> corners;

  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    corners.insert(corners.end(), {a, b, c, a, c, d});
  }
  void card(const Vec3& foot, const Vec3& side, const Vec3& up) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const Vec3& p : {foot - side, foot + side, foot + side + up, foot - side + up}) positions.push_back(p);
    quad(first, first + 1, first + 2, first + 3);
  }
  TubeShape shape() const {
    std::vector<std::uint32_t> all(corners.size() / 3), joined;
    for (std::uint32_t t = 0; t < all.size(); ++t) all[t] = t;
    const auto place = joined_by_place(positions);
    for (const std::uint32_t c : corners) joined.push_back(place[c]);
    return tube_shape(positions, joined, all);
  }
};

/// A tube along half a circle of radius 1 in the xz plane; its seam's vertices are double.
Surface bent_tube(float radius, int rings, int sides) {
  Surface s;
  for (int r = 0; r <= rings; ++r) {
    const float turn = kPi * static_cast<float>(r) / static_cast<float>(rings);
    const Vec3 out(-std::cos(turn), 0, std::sin(turn));
    for (int k = 0; k <= sides; ++k) {
      const float a = 2 * kPi * static_cast<float>(k) / static_cast<float>(sides);
      const float thin = radius * (1 - 0.5F * static_cast<float>(r) / static_cast<float>(rings));
      s.positions.push_back(out + (out * std::cos(a) + Vec3(0, std::sin(a), 0)) * thin);
    }
  }
  const auto row = static_cast<std::uint32_t>(sides + 1);
  for (std::uint32_t r = 0; r < static_cast<std::uint32_t>(rings); ++r)
    for (std::uint32_t k = 0; k + 1 < row; ++k)
      s.quad(r * row + k, r * row + k + 1, (r + 1) * row + k + 1, (r + 1) * row + k);
  return s;
}

using Line = std::vector<CentrePoint>;
Line straight(const Vec3& foot, const Vec3& tip, float radius, float end) { return {{foot, radius}, {tip, end}}; }

Vec3 anywhere(Random& random) { return {random.spread(1), random.spread(1), random.spread(1)}; }

}  // namespace

TEST_CASE("places a hair apart are one, wherever the grid's lines fall, and others are not") {
  Random random(3);
  std::vector<Vec3> positions{Vec3(-1), Vec3(1)};
  for (int i = 0; i < 2000; ++i) {
    positions.push_back(anywhere(random));
    positions.push_back(positions.back() + anywhere(random) * 1e-7F);
  }
  const auto joined = joined_by_place(positions);
  std::size_t pairs = 0;
  for (std::size_t i = 2; i < joined.size(); i += 2) pairs += joined[i] == joined[i + 1];
  CHECK(pairs == 2000);
  CHECK(std::set<std::uint32_t>(joined.begin(), joined.end()).size() == 2002);
}

TEST_CASE("pieces hang together by corners, and keys part them") {
  const std::vector<std::uint32_t> corners{0, 1, 2, 5, 6, 7, 2, 3, 4, 7, 8, 9, 4, 10, 11};
  const Pieces all = connected_pieces(corners, std::vector<std::uint32_t>(5, 0));
  REQUIRE(all.count() == 2);
  CHECK(std::vector(all.of(0).begin(), all.of(0).end()) == std::vector<std::uint32_t>{0, 2, 4});
  CHECK(std::vector(all.of(1).begin(), all.of(1).end()) == std::vector<std::uint32_t>{1, 3});
  CHECK(connected_pieces(corners, std::vector<std::uint32_t>{0, 0, 1, 0, 1}).count() == 3);
  CHECK(connected_pieces({}, {}).count() == 0);
}

TEST_CASE("the centre line of a tube bent by half a circle lies on the circle") {
  for (const int sides : {3, 6, 12}) {
    const TubeShape shape = bent_tube(0.1F, 12, sides).shape();
    REQUIRE(shape.line.size() == 13);
    for (const CentrePoint& p : shape.line) CHECK(glm::length(p.position) == Approx(1).margin(1e-4));
    const float thick = std::max(shape.line.front().radius, shape.line.back().radius);
    CHECK(thick == Approx(0.1).epsilon(0.05));
    CHECK(shape.roundness > 0.8F);
    CHECK(shape.slenderness > 15);
    CHECK(shape.openings == 2);
  }
}

TEST_CASE("cards, crossed cards and bent leaves are not round, balls are not slender") {
  Surface card;
  card.card({0, 0, 0}, {0.5F, 0, 0}, {0, 0.3F, 1});
  CHECK(card.shape().roundness < 0.01F);
  Surface crossed = card;
  crossed.card({0, 0, 0}, {0, 0.5F, 0}, {0, 0.3F, 1});
  CHECK(crossed.shape().roundness < 0.3F);
  Surface leaf;
  for (std::uint32_t i = 0; i <= 6; ++i) {
    const float a = 0.25F * static_cast<float>(i);
    for (const float x : {-0.2F, 0.2F}) leaf.positions.emplace_back(x, std::sin(a), std::cos(a));
    if (i > 0) leaf.quad(2 * i - 2, 2 * i - 1, 2 * i + 1, 2 * i);
  }
  CHECK(leaf.shape().roundness < 0.1F);
  Surface blade = leaf;
  for (Vec3& p : blade.positions) p.x *= 0.1F;
  CHECK(blade.shape().roundness < 0.1F);
  CHECK(blade.shape().slenderness > 20);
  Surface ball;
  constexpr std::uint32_t kRings = 9, kSides = 12;
  for (std::uint32_t r = 0; r <= kRings; ++r)
    for (std::uint32_t k = 0; k <= kSides; ++k) {
      const float a = kPi * static_cast<float>(r) / kRings, b = 2 * kPi * static_cast<float>(k) / kSides;
      ball.positions.emplace_back(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a));
      if (r > 0 && k > 0) {
        const std::uint32_t at = r * (kSides + 1) + k;
        ball.quad(at, at - 1, at - kSides - 2, at - kSides - 1);
      }
    }
  CHECK(ball.shape().slenderness < 8);
}

TEST_CASE("surfaces without extent have a line all the same") {
  Surface point;
  for (int i = 0; i < 3; ++i) point.positions.emplace_back(1, 2, 3);
  point.corners = {0, 1, 2};
  Surface needle = point;
  needle.positions[1].x = 2;
  for (const Surface* s : {&point, &needle}) {
    const TubeShape shape = s->shape();
    CHECK(shape.line.size() >= 2);
    for (const CentrePoint& p : shape.line) CHECK(std::isfinite(glm::length(p.position) + p.radius));
    CHECK(shape.roundness == 0);
  }
}

TEST_CASE("lines are turned and hung on what is thicker where they start") {
  // A trunk, upside down in the list; a bough that starts on it; a twig on the bough, near the trunk; an untapered
  // twig.
  std::vector<Line> lines{
      straight({2, 0, 3}, {0.35F, 0, 2.5F}, 0.01F, 0.02F), straight({0, 0, 5}, {0, 0, 0}, 0.1F, 0.3F),
      straight({0, 0, 2.5F}, {2, 0, 2.5F}, 0.08F, 0.02F), straight({1.5F, 1, 2.5F}, {1.5F, 0, 2.5F}, 0.01F, 0.01F)};
  const JoinedLines joined = join_lines(lines);
  CHECK(joined.order == std::vector<std::uint32_t>{1, 2, 0, 3});
  CHECK(joined.parent == std::vector<std::int32_t>{-1, 0, 1, 1});
  CHECK(joined.level == std::vector<std::uint16_t>{0, 1, 2, 2});
  CHECK(lines[1][0].position.z == 0);
  CHECK(lines[3][0].position.y == 0);
}

TEST_CASE("stems that stand apart on the ground are roots, and what hangs in the air is not") {
  std::vector<Line> lines{straight({0, 0, 0}, {0, 0, 2}, 0.05F, 0.01F), straight({1, 0, 0}, {1, 0, 2}, 0.05F, 0.01F),
                          straight({0.3F, 0, 1}, {0.6F, 0, 1.2F}, 0.02F, 0.01F)};
  const JoinedLines joined = join_lines(lines);
  CHECK(std::count(joined.parent.begin(), joined.parent.end(), -1) == 2);
  CHECK(join_lines(lines = {}).order.empty());
}

TEST_CASE("any lines become rows after their parents, each once") {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed);
    std::vector<Line> lines;
    for (std::uint64_t i = 0; i < 1 + random.bits() % 60; ++i) {
      const float same = seed % 3 == 0 ? 0.1F : random.uniform();  // equal radii and equal places too
      lines.push_back(straight(seed % 2 == 0 ? Vec3(0) : anywhere(random), anywhere(random), same, same));
    }
    const JoinedLines joined = join_lines(lines);
    REQUIRE(joined.order.size() == lines.size());
    CHECK(std::set<std::uint32_t>(joined.order.begin(), joined.order.end()).size() == lines.size());
    for (std::size_t row = 0; row < joined.parent.size(); ++row) {
      CHECK(joined.parent[row] >= -1);
      CHECK(joined.parent[row] < static_cast<std::int32_t>(row));
    }
    CHECK(joined.parent[0] == -1);
  }
}

TEST_CASE("the tree of lines finds what asking every line finds") {
  Random random(5);
  std::vector<Branch> branches;
  std::vector<CentrePoint> points;
  for (std::uint32_t b = 0; b < 200; ++b) {
    branches.push_back({-1, 0, {3 * b, 3 * b + 3}, {}});
    const Vec3 foot = anywhere(random);
    for (int i = 0; i < 3; ++i) points.push_back({foot + anywhere(random) * 0.2F, 0.02F * random.uniform()});
  }
  const LineTree tree(branches, points);
  for (int i = 0; i < 500; ++i) {
    const Vec3 place = anywhere(random);
    const std::uint32_t left_out = static_cast<std::uint32_t>(random.bits() % 3);
    const auto keep = [&](std::uint32_t b) { return b % 3 != left_out; };
    float best = HUGE_VALF;
    for (std::uint32_t b = 0; b < branches.size(); ++b) {
      if (!keep(b)) continue;
      const LineTree alone(std::span(&branches[b], 1), points);
      best = std::min(best, alone.nearest(place, i % 2 == 0, [](std::uint32_t) { return true; }).distance);
    }
    CHECK(tree.nearest(place, i % 2 == 0, keep).distance == best);
  }
  CHECK(std::isinf(tree.nearest({0, 0, 0}, false, [](std::uint32_t) { return false; }).distance));
}

#include "culling/baselines/town.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "culling/baselines/random.h"

namespace manzana::baselines {
namespace {

using culling::BlockVolume;
using culling::BoxD;

/// The numbers of one purpose.
Random dice(std::uint64_t seed, std::uint64_t purpose) { return Random(hash_bits(seed, purpose)); }

/// Closed rectangle of the plane.
struct Rect {
  Vec2d low{0, 0}, high{0, 0};
  Vec2d size() const { return high - low; }
};

BoxD stand_on(const Rect& r, double height) { return {Vec3d(r.low, 0), Vec3d(r.high, height)}; }
Rect square_at(const Vec2d& middle, const Vec2d& half) { return {middle - half, middle + half}; }

/// Along one axis: where the middle of the street before the block is, and where its ground begins and ends.
struct Stretch {
  double street = 0, low = 0, high = 0, next_street = 0;
};

double half_street(std::uint32_t i) { return i % 5 == 0 ? 15.0 : 7.0; }  // every fifth is an avenue

std::vector<Stretch> stretches(std::uint32_t count, Random dice) {
  std::vector<Stretch> all;
  double at = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double low = at + half_street(i), high = low + dice.in(60, 120);
    all.push_back({at, low, high, high + half_street(i + 1)});
    at = all.back().next_street;
  }
  for (Stretch& s : all) s = {s.street - at / 2, s.low - at / 2, s.high - at / 2, s.next_street - at / 2};
  return all;
}

/// Lives for one block.
class BlockMaker {
 public:
  BlockMaker(const Stretch& x, const Stretch& y, Random dice)
      : cell_{{x.street, y.street}, {x.next_street, y.next_street}},
        kerb_{{x.low, y.low}, {x.high, y.high}},
        dice_(dice) {
    ground_.low = kerb_.low + Vec2d{dice_.in(1, 9), dice_.in(1, 9)};
    ground_.high = kerb_.high - Vec2d{dice_.in(1, 9), dice_.in(1, 9)};
  }

  void fill(std::uint32_t count, City& city) {
    const std::size_t begin = city.boxes.size();
    add_houses(city);
    const auto houses = static_cast<std::uint32_t>(city.boxes.size() - begin);
    for (std::uint32_t i = houses; i < count; ++i) dice_.chance(0.4) ? add_car(city) : add_tree(city);
    BoxD box = stand_on(cell_, 0);
    for (std::size_t i = begin; i < city.boxes.size(); ++i) box = merge(box, city.boxes[i]);
    city.blocks.push_back({(ground_.low + ground_.high) / 2.0, box, culling::enclosing_sphere(box)});
    city.first.push_back(city.objects());
    city.bounds = merge(city.bounds, box);
  }

 private:
  static void add(City& city, const BoxD& box, ObjectKind kind) {
    city.boxes.push_back(box);
    city.kinds.push_back(kind);
  }

  /// A house on each lot at the edge of the ground; 4 to 12.
  void add_houses(City& city) {
    const Vec2d lots = glm::clamp(glm::round(ground_.size() / 28.0), 2.0, 4.0);
    const Vec2d lot = ground_.size() / lots;
    const double storeys = dice_.in(6, 24);
    for (double y = 0; y < lots.y; ++y)
      for (double x = 0; x < lots.x; ++x)
        if (x == 0 || y == 0 || x == lots.x - 1 || y == lots.y - 1)
          add(city, house({ground_.low + Vec2d{x, y} * lot, ground_.low + Vec2d{x + 1, y + 1} * lot}, storeys),
              ObjectKind::building);
  }

  BoxD house(const Rect& lot, double usual) {
    const Vec2d before{dice_.in(0, 3), dice_.in(0, 3)}, behind{dice_.in(0, 8), dice_.in(0, 8)};
    const bool tower = dice_.chance(0.02);
    return stand_on({lot.low + before, lot.high - behind}, tower ? dice_.in(50, 100) : usual + dice_.in(0, 16));
  }

  /// A place on one of the two lines along x (or y) that lie `out` metres beyond the rectangle.
  Vec2d beside(const Rect& edge, double out, bool along_x) {
    const Vec2d at{dice_.in(edge.low.x, edge.high.x), dice_.in(edge.low.y, edge.high.y)};
    const bool upper = dice_.chance(0.5);
    if (along_x) return {at.x, upper ? edge.high.y + out : edge.low.y - out};
    return {upper ? edge.high.x + out : edge.low.x - out, at.y};
  }

  void add_tree(City& city) {
    const double radius = dice_.in(1.5, 4);
    const Vec2d yard{dice_.in(ground_.low.x, ground_.high.x), dice_.in(ground_.low.y, ground_.high.y)};
    const Vec2d at = dice_.chance(0.5) ? beside(kerb_, -1, dice_.chance(0.5)) : yard;
    add(city, stand_on(square_at(at, Vec2d(radius)), radius * dice_.in(2, 3.5)), ObjectKind::tree);
  }

  void add_car(City& city) {
    const bool along_x = dice_.chance(0.5);
    const Vec2d half = along_x ? Vec2d{2.2, 0.9} : Vec2d{0.9, 2.2};
    add(city, stand_on(square_at(beside(kerb_, dice_.in(1, 5.5), along_x), half), 1.5), ObjectKind::car);
  }

  Rect cell_, kerb_, ground_;  ///< to the middles of its streets; to the kerb; what is built on
  Random dice_;
};

/// Blocks in pairs, one as much above the average as the other is below it, so that the sum is known.
std::uint32_t objects_of(const TownPlan& plan, std::uint32_t block, std::uint64_t seed) {
  if ((block | 1U) >= plan.blocks) return plan.per_block;
  const std::uint32_t more = static_cast<std::uint32_t>(dice(seed, block / 2).below(11));
  return block % 2 == 0 ? plan.per_block + more : plan.per_block - more;
}

/// Cars have the paper's; the rest goes to houses and trees, by chance, five times as many to a house.
void share_triangles(City& city, std::uint64_t total, Random dice) {
  std::vector<double> sum{0};
  std::uint64_t rest = total;
  for (const ObjectKind kind : city.kinds) {
    const bool car = kind == ObjectKind::car;
    sum.push_back(sum.back() + (car ? 0 : dice.in(0.5, 1.5) * (kind == ObjectKind::building ? 5 : 1)));
    if (car) rest -= kCarTriangles;
  }
  assert(rest < total);
  const auto up_to = [&](std::size_t i) {
    return static_cast<std::uint64_t>(std::floor(static_cast<double>(rest) * (sum[i] / sum.back())));
  };
  for (std::uint32_t i = 0; i < city.objects(); ++i)
    city.triangles.push_back(city.kinds[i] == ObjectKind::car ? kCarTriangles
                                                              : static_cast<std::uint32_t>(up_to(i + 1) - up_to(i)));
}

}  // namespace

City grow_town(const TownPlan& plan, std::uint64_t seed) {
  enum Stream : std::uint64_t { kColumns, kRows, kCounts, kTriangles, kBlocks };
  const std::uint32_t rows = (plan.blocks + plan.columns - 1) / plan.columns;
  const auto xs = stretches(plan.columns, dice(seed, kColumns)), ys = stretches(rows, dice(seed, kRows));
  City city;
  for (std::uint32_t b = 0; b < plan.blocks; ++b)
    BlockMaker(xs[b % plan.columns], ys[b / plan.columns], dice(seed, kBlocks + b))
        .fill(objects_of(plan, b, hash_bits(seed, kCounts)), city);
  share_triangles(city, plan.triangles, dice(seed, kTriangles));
  return city;
}

}  // namespace manzana::baselines

#include <algorithm>
#include <cmath>

#include "scenegraph/import/traffic_check.h"
#include "scenegraph/import/traffic_signals.h"

namespace manzana {
namespace {

constexpr double kCell = 24;          // metres, of the grids that find neighbours
constexpr double kStep = 0.8;         // metres, from sample to sample
constexpr double kLaneEnd = 2.5;      // metres of lane at each end of a way that are timed with the way
constexpr double kAirLength = 0.5;    // kept free round cars, both ends together
constexpr double kAirWidth = 0.16;    // and both sides
constexpr double kHalfReach = 3;      // metres: more than half the diagonal of an enlarged car
constexpr double kCrossing = 1.35;    // metres: what lines that meet at right angles keep apart beyond a car's width
constexpr double kTimeMargin = 0.12;  // seconds
constexpr double kSameLine = 10;      // metres: rides with less between them follow each other

Vec2d plan(const Vec3d& p) { return {p.x, p.y}; }
double cross(const Vec2d& a, const Vec2d& b) { return a.x * b.y - a.y * b.x; }

/// Items by the cells that their boxes touch; afterwards sorted by cell.
struct CellItem {
  std::int64_t cell;
  std::uint32_t item;
};
void add_to_cells(std::vector<CellItem>& cells, const Vec2d& low, const Vec2d& high, std::uint32_t item) {
  const auto index = [](double v) { return static_cast<std::int64_t>(std::floor(v / kCell)); };
  for (std::int64_t x = index(low.x); x <= index(high.x); ++x)
    for (std::int64_t y = index(low.y); y <= index(high.y); ++y) cells.push_back({x * 0x80000000 + y, item});
}

/// All pairs of items with a cell in common that pass the test, each once, in order.
template <class Test>  // bool(a, b), a < b; may be asked more than once
std::vector<std::pair<std::uint32_t, std::uint32_t>> close_pairs(std::vector<CellItem>& cells, Test&& test) {
  std::sort(cells.begin(), cells.end(),
            [](const CellItem& a, const CellItem& b) { return a.cell != b.cell ? a.cell < b.cell : a.item < b.item; });
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::size_t begin = 0, end = 0; begin < cells.size(); begin = end) {
    while (end < cells.size() && cells[end].cell == cells[begin].cell) ++end;
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t k = i + 1; k < end; ++k)
        if (test(cells[i].item, cells[k].item)) pairs.emplace_back(cells[i].item, cells[k].item);
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

/// Metres of line between two rides of a circuit, if b follows a closely; else far more than kSameLine.
double metres_ahead(const std::vector<Lane>& lanes, const std::vector<Ride>& rides, std::uint32_t a, std::uint32_t b) {
  double sum = 0;
  for (std::uint32_t r = rides[a].next; sum < kSameLine; r = rides[r].next) {
    if (r == b) return sum;
    sum += lanes[rides[r].lane].length + rides[r].way_length;
  }
  return 1e9;
}
bool same_line(const std::vector<Lane>& lanes, const std::vector<Ride>& rides, std::uint32_t a, std::uint32_t b) {
  return metres_ahead(lanes, rides, a, b) < kSameLine || metres_ahead(lanes, rides, b, a) < kSameLine;
}

struct Rectangle {
  Vec2d low{1e300}, high{-1e300};
  void add(const Vec2d& p) { low = glm::min(low, p), high = glm::max(high, p); }
};
/// Within twice kHalfReach.
bool meet(const Rectangle& a, const Rectangle& b) {
  return glm::all(glm::lessThan(a.low - 2 * kHalfReach, b.high)) &&
         glm::all(glm::lessThan(b.low - 2 * kHalfReach, a.high));
}

/// A car on a ride, `time` seconds after its slot.
struct Sample {
  CarOutline car;
  double time;
};

class ConflictFinder {
 public:
  ConflictFinder(const std::vector<Lane>& lanes, const std::vector<Ride>& rides) : lanes_(lanes), rides_(rides) {
    for (const Ride& ride : rides) append_samples(ride);
  }

  std::vector<Conflict> run() {
    std::vector<CellItem> cells;
    std::vector<Rectangle> boxes(rides_.size());
    for (std::uint32_t r = 0; r < rides_.size(); ++r) {
      for (std::uint32_t i = first_[r]; i < first_[r + 1]; ++i) boxes[r].add(samples_[i].car.position);
      add_to_cells(cells, boxes[r].low - kHalfReach, boxes[r].high + kHalfReach, r);
    }
    std::vector<Conflict> conflicts;
    const auto near = [&](std::uint32_t a, std::uint32_t b) { return meet(boxes[a], boxes[b]); };
    for (const auto& [a, b] : close_pairs(cells, near)) append_conflict(conflicts, a, b);
    return conflicts;
  }

 private:
  void append_samples(const Ride& ride) {
    const auto &lane = lanes_[ride.lane].line, &onward = lanes_[rides_[ride.next].lane].line;
    const double before = std::min(kLaneEnd, lanes_[ride.lane].length / 2);
    const double after = std::min(kLaneEnd, lanes_[rides_[ride.next].lane].length / 2);
    const Vec3d tail = lane.back() - glm::normalize(Vec3d(plan(lane.back() - lane[lane.size() - 2]), 0)) * before;
    const Vec3d head = onward[0] + glm::normalize(Vec3d(plan(onward[1] - onward[0]), 0)) * after;
    double s = sample(tail, ride.way.front(), -before, ride.way_speed);
    for (std::size_t i = 1; i < ride.way.size(); ++i) s = sample(ride.way[i - 1], ride.way[i], s, ride.way_speed);
    sample(ride.way.back(), head, s, ride.way_speed);
    first_.push_back(static_cast<std::uint32_t>(samples_.size()));
  }

  double sample(const Vec3d& a, const Vec3d& b, double s, double speed) {
    const double length = glm::distance(plan(a), plan(b));
    const int steps = std::max(1, static_cast<int>(std::ceil(length / kStep)));
    for (int i = s < 0 ? 0 : 1; i <= steps; ++i) {
      const Vec3d p = glm::mix(a, b, double(i) / steps);
      samples_.push_back({{plan(p), plan(b - a) / std::max(length, 1e-9), p.z}, (s + length * i / steps) / speed});
    }
    return s + length;
  }

  static bool near(const Sample& a, const Sample& b) {
    const Vec2d d = b.car.position - a.car.position;
    return glm::dot(d, d) < 36 && touch(a.car, b.car, kAirLength, kAirWidth);
  }

  void append_conflict(std::vector<Conflict>& conflicts, std::uint32_t a, std::uint32_t b) const {
    Conflict c{a, b, 1e300, -1e300};
    for (std::uint32_t i = first_[a]; i < first_[a + 1]; ++i)
      for (std::uint32_t k = first_[b]; k < first_[b + 1]; ++k) {
        if (!near(samples_[i], samples_[k])) continue;
        c.low = std::min(c.low, samples_[k].time - samples_[i].time);
        c.high = std::max(c.high, samples_[k].time - samples_[i].time);
      }
    if (c.low > c.high || same_line(lanes_, rides_, a, b)) return;
    const double margin = kTimeMargin + kStep / 2 * (1 / rides_[a].way_speed + 1 / rides_[b].way_speed);
    conflicts.push_back({a, b, c.low - margin, c.high + margin});
  }

  const std::vector<Lane>& lanes_;
  const std::vector<Ride>& rides_;
  std::vector<Sample> samples_;
  std::vector<std::uint32_t> first_{0};  // rides + 1
};

/// A straight part of a lane or a way.
struct Strip {
  Vec2d a, b;
  double height;
  std::uint32_t ride;
  bool on_way;
};

double point_distance(const Vec2d& p, const Strip& s) {
  const Vec2d d = s.b - s.a;
  const double t = std::clamp(glm::dot(p - s.a, d) / std::max(glm::dot(d, d), 1e-12), 0.0, 1.0);
  return glm::distance(p, s.a + d * t);
}

double distance(const Strip& s, const Strip& t) {
  const Vec2d d = s.b - s.a, e = t.b - t.a;
  const bool crossing = cross(d, t.a - s.a) * cross(d, t.b - s.a) < 0 && cross(e, s.a - t.a) * cross(e, s.b - t.a) < 0;
  if (crossing) return 0;
  return std::min(std::min(point_distance(s.a, t), point_distance(s.b, t)),
                  std::min(point_distance(t.a, s), point_distance(t.b, s)));
}

bool overlap(const Strip& s, const Strip& t) {
  if (std::abs(s.height - t.height) > kHeadroom) return false;
  const Vec2d d = s.b - s.a, e = t.b - t.a;
  const Vec2d apart = glm::max(glm::min(s.a, s.b) - glm::max(t.a, t.b), glm::min(t.a, t.b) - glm::max(s.a, s.b));
  if (std::max(apart.x, apart.y) > kCarWidth + kCrossing) return false;
  const double sine = std::abs(cross(d, e)) / std::max(glm::length(d) * glm::length(e), 1e-12);
  return distance(s, t) < kCarWidth + 0.15 + (kCrossing - 0.15) * sine;
}

void append_strips(std::vector<Strip>& strips, const std::vector<Vec3d>& line, double begin, double end,
                   std::uint32_t ride, bool on_way) {
  double s = 0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double length = glm::distance(plan(line[i - 1]), plan(line[i]));
    const double from = std::max(begin, s), to = std::min(end, s + length);
    const int parts = static_cast<int>(std::ceil((to - from) / 16));
    for (int k = 0; k < parts; ++k) {
      const auto at = [&](int n) {
        return glm::mix(line[i - 1], line[i], (from + (to - from) * n / parts - s) / length);
      };
      strips.push_back({plan(at(k)), plan(at(k + 1)), at(k).z, ride, on_way});
    }
    s += length;
  }
}

}  // namespace

std::vector<Conflict> find_conflicts(const std::vector<Lane>& lanes, const std::vector<Ride>& rides) {
  return ConflictFinder(lanes, rides).run();
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> find_overlaps(const std::vector<Lane>& lanes,
                                                                   const std::vector<Ride>& rides) {
  std::vector<Strip> strips;
  for (std::uint32_t r = 0; r < rides.size(); ++r) {
    const Lane& lane = lanes[rides[r].lane];
    append_strips(strips, lane.line, kLaneEnd, lane.length - kLaneEnd, r, false);
    append_strips(strips, rides[r].way, 0, 1e9, r, true);
  }
  std::vector<CellItem> cells;
  for (std::uint32_t i = 0; i < strips.size(); ++i)
    add_to_cells(cells, glm::min(strips[i].a, strips[i].b) - 1.7, glm::max(strips[i].a, strips[i].b) + 1.7, i);
  const auto near = [&](std::uint32_t i, std::uint32_t k) {
    const Strip &s = strips[i], &t = strips[k];
    if ((s.on_way && t.on_way) || s.ride == t.ride) return false;
    const bool opposite = !s.on_way && !t.on_way && lanes[rides[s.ride].lane].edge == lanes[rides[t.ride].lane].edge;
    return !opposite && overlap(s, t) && !same_line(lanes, rides, s.ride, t.ride);
  };
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  for (const auto& [i, k] : close_pairs(cells, near)) found.emplace_back(strips[i].ride, strips[k].ride);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace manzana

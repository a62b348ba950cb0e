#include "scenegraph/import/plan_index.h"

#include <algorithm>
#include <cmath>

#include "scenegraph/import/plan_geometry.h"

namespace manzana::plan {
namespace {

constexpr double kFarthest = 1e7;  // metres; what lies further is a mistake

std::uint64_t mix(std::uint64_t x) {  // splitmix64's finaliser
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9U;
  x = (x ^ x >> 27) * 0x94d049bb133111ebU;
  return x ^ x >> 31;
}

bool near(const Vec2d& p) { return std::abs(p.x) <= kFarthest && std::abs(p.y) <= kFarthest; }

double crossing(const Vec2d& a, const Vec2d& b, double y) { return a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)); }

}  // namespace

bool PolygonRows::measure(const Polygon& shape) {
  const auto add = [this](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) edges_.push_back({ring[i], ring[(i + 1) % ring.size()]});
  };
  add(shape.outer);
  for (const Ring& hole : shape.holes) add(hole);
  if (shape.outer.size() < 3) return false;
  low_ = high_ = edges_[0].a;
  for (const Edge& e : edges_) {
    if (!near(e.a)) return false;
    low_ = glm::min(low_, e.a);
    high_ = glm::max(high_, e.a);
  }
  return true;
}

PolygonRows::PolygonRows(const Polygon& shape, double row_height) {
  if (measure(shape)) fill(row_height);
}

PolygonRows::PolygonRows(const Polygon& shape) {
  if (!measure(shape)) return;
  fill(std::max((high_.y - low_.y) / std::min(static_cast<double>(edges_.size()), 4096.0), 1e-3));
}

template <class Visit>
void PolygonRows::rows_of(const Edge& edge, Visit&& visit) const {
  const auto [low, high] = std::minmax(edge.a.y, edge.b.y);
  const auto last = static_cast<std::int64_t>(std::floor(high / height_)) - row_low_;
  for (auto r = static_cast<std::int64_t>(std::floor(low / height_)) - row_low_; r <= last; ++r)
    visit(static_cast<std::size_t>(r));
}

void PolygonRows::fill(double row_height) {
  height_ = row_height;
  row_low_ = static_cast<std::int64_t>(std::floor(low_.y / height_));
  double entries = 0;
  for (const Edge& e : edges_) entries += 2 + std::abs(e.a.y - e.b.y) / height_;
  const double rows = (high_.y - low_.y) / height_ + 2;
  if (!(std::max(entries, rows) < static_cast<double>(kMostEntries))) return;
  const auto row_high = static_cast<std::int64_t>(std::floor(high_.y / height_));
  std::vector<std::uint32_t> first(static_cast<std::size_t>(row_high - row_low_) + 2);
  for (const Edge& e : edges_) rows_of(e, [&](std::size_t r) { ++first[r + 1]; });
  for (std::size_t r = 1; r < first.size(); ++r) first[r] += first[r - 1];
  entries_.resize(first.back());
  std::vector<std::uint32_t> next = first;
  for (std::uint32_t i = 0; i < edges_.size(); ++i) rows_of(edges_[i], [&](std::size_t r) { entries_[next[r]++] = i; });
  first_ = std::move(first);
}

bool PolygonRows::contains(const Vec2d& p) const {
  if (!valid() || p.y < low_.y || p.y > high_.y || p.x < low_.x || p.x > high_.x) return false;
  const auto row = static_cast<std::size_t>(static_cast<std::int64_t>(std::floor(p.y / height_)) - row_low_);
  bool inside = false;
  for (std::uint32_t i = first_[row]; i < first_[row + 1]; ++i) {
    const Edge& e = edges_[entries_[i]];
    if ((e.a.y > p.y) != (e.b.y > p.y) && p.x < crossing(e.a, e.b, p.y)) inside = !inside;
  }
  return inside;
}

std::vector<PolygonRows::Span> PolygonRows::spans(std::int64_t row) const {
  const auto r = static_cast<std::size_t>(row - row_low_);
  const double bottom = static_cast<double>(row) * height_, top = bottom + height_, middle = (bottom + top) / 2;
  std::vector<Span> spans;
  std::vector<double> crossings;
  for (std::uint32_t i = first_[r]; i < first_[r + 1]; ++i) {
    const Edge& e = edges_[entries_[i]];
    const auto at = [&](double y) {
      return e.a.y == e.b.y ? e.a.x : crossing(e.a, e.b, std::clamp(y, std::min(e.a.y, e.b.y), std::max(e.a.y, e.b.y)));
    };
    const auto [low, high] = e.a.y == e.b.y ? std::minmax({e.a.x, e.b.x}) : std::minmax({at(bottom), at(top)});
    spans.push_back({low, high});
    if ((e.a.y > middle) != (e.b.y > middle)) crossings.push_back(crossing(e.a, e.b, middle));
  }
  std::sort(crossings.begin(), crossings.end());
  for (std::size_t i = 1; i < crossings.size(); i += 2) spans.push_back({crossings[i - 1], crossings[i]});
  std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) { return a.low < b.low; });
  std::vector<Span> merged;
  for (const Span& s : spans) {
    if (!merged.empty() && s.low <= merged.back().high) {
      merged.back().high = std::max(merged.back().high, s.high);
    } else {
      merged.push_back(s);
    }
  }
  return merged;
}

std::int64_t CellMap::index(double v) const { return static_cast<std::int64_t>(std::floor(v / cell_)); }

std::uint64_t CellMap::key(std::int64_t x, std::int64_t y) {
  return static_cast<std::uint64_t>(x) << 32 ^ (static_cast<std::uint64_t>(y) & 0xffffffffU);
}

std::uint64_t CellMap::cells(const Vec2d& low, const Vec2d& high) const {
  return static_cast<std::uint64_t>((index(high.x) - index(low.x) + 1) * (index(high.y) - index(low.y) + 1));
}

void CellMap::add(const Vec2d& low, const Vec2d& high, std::uint32_t id) {
  for (std::int64_t y = index(low.y); y <= index(high.y); ++y)
    for (std::int64_t x = index(low.x); x <= index(high.x); ++x) ids_[key(x, y)].push_back(id);
}

std::span<const std::uint32_t> CellMap::at(const Vec2d& p) const {
  const auto found = ids_.find(key(index(p.x), index(p.y)));
  return found == ids_.end() ? std::span<const std::uint32_t>{} : std::span<const std::uint32_t>(found->second);
}

void KeepClear::add(const Vec2d& a, const Vec2d& b, double clearance) {
  if (!near(a) || !near(b) || !(clearance > 0 && clearance < 1000)) return;
  constexpr double kStep = 64;  // metres: a long diagonal's box would fill a square of cells
  const int steps = static_cast<int>(std::min(std::ceil(glm::distance(a, b) / kStep), 1e5));
  for (int i = 0; i < std::max(steps, 1); ++i) {
    const Vec2d p = a + (b - a) * (i / double(std::max(steps, 1)));
    const Vec2d q = a + (b - a) * ((i + 1) / double(std::max(steps, 1)));
    cells_.add(glm::min(p, q) - clearance, glm::max(p, q) + clearance, static_cast<std::uint32_t>(segments_.size()));
    segments_.push_back({p, q, clearance});
  }
}

bool KeepClear::hit(const Vec2d& p) const {
  const auto ids = cells_.at(p);
  return std::any_of(ids.begin(), ids.end(), [&](std::uint32_t id) {
    const Segment& s = segments_[id];
    const Vec2d d = s.b - s.a;
    const double square = glm::dot(d, d);
    const double t = square > 0 ? std::clamp(glm::dot(p - s.a, d) / square, 0.0, 1.0) : 0;
    return glm::distance(p, s.a + d * t) < s.clearance;
  });
}

void PolygonSet::add(const Polygon& shape) {
  PolygonRows rows(shape);
  if (!rows.valid()) return;
  constexpr std::uint64_t kMostCells = 16384;
  const auto id = static_cast<std::uint32_t>(polygons_.size());
  if (cells_.cells(rows.low(), rows.high()) > kMostCells) {
    large_.push_back(id);
  } else {
    cells_.add(rows.low(), rows.high(), id);
  }
  polygons_.push_back(std::move(rows));
}

bool PolygonSet::contains(const Vec2d& p) const {
  const auto inside = [&](std::uint32_t id) { return polygons_[id].contains(p); };
  const auto ids = cells_.at(p);
  return std::any_of(ids.begin(), ids.end(), inside) || std::any_of(large_.begin(), large_.end(), inside);
}

PointGrid::PointGrid(double cell) : cell_(cell), slots_(1024) {}

std::int32_t PointGrid::index(double v) const { return static_cast<std::int32_t>(std::floor(v / cell_)); }

std::size_t PointGrid::find(std::int32_t x, std::int32_t y) const {
  const std::uint64_t key = std::uint64_t{static_cast<std::uint32_t>(x)} << 32 | static_cast<std::uint32_t>(y);
  const std::size_t mask = slots_.size() - 1;
  std::size_t i = mix(key) & mask;
  while (slots_[i].head != 0 && (slots_[i].x != x || slots_[i].y != y)) i = (i + 1) & mask;
  return i;
}

void PointGrid::grow() {
  std::vector<Slot> old(slots_.size() * 2);
  old.swap(slots_);
  for (const Slot& slot : old)
    if (slot.head != 0) slots_[find(slot.x, slot.y)] = slot;
}

void PointGrid::insert(const Vec2d& p) {
  if (2 * used_ >= slots_.size()) grow();
  const std::int32_t x = index(p.x), y = index(p.y);
  Slot& slot = slots_[find(x, y)];
  if (slot.head == 0) ++used_;
  points_.push_back(p);
  next_.push_back(slot.head);
  slot = {x, y, static_cast<std::uint32_t>(points_.size())};
}

bool PointGrid::any_within(const Vec2d& p, double distance) const {
  for (std::int32_t y = index(p.y - distance); y <= index(p.y + distance); ++y)
    for (std::int32_t x = index(p.x - distance); x <= index(p.x + distance); ++x)
      for (std::uint32_t i = slots_[find(x, y)].head; i != 0; i = next_[i - 1]) {
        const Vec2d d = points_[i - 1] - p;
        if (glm::dot(d, d) < distance * distance) return true;
      }
  return false;
}

}  // namespace manzana::plan

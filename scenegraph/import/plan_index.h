#pragma once
/// Point questions in plan, answered quickly: inside which polygon, near which line, near which other point.
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "scenegraph/import/features.h"

namespace manzana::plan {

/// A polygon's edges by rows of equal height; inside by the even-odd rule over all rings, whatever their direction.
class PolygonRows {
 public:
  /// Rows [floor(low / height), floor(high / height)] of the y axis. `valid()` is false where the polygon is not finite
  /// or would need more than kMostEntries entries.
  PolygonRows(const Polygon& shape, double row_height);
  /// About as many rows as edges.
  explicit PolygonRows(const Polygon& shape);
  bool valid() const { return !first_.empty(); }
  bool contains(const Vec2d& p) const;

  std::int64_t row_low() const { return row_low_; }
  std::int64_t row_high() const { return row_low_ + static_cast<std::int64_t>(first_.size()) - 2; }  ///< inclusive
  struct Span {
    double low, high;
  };
  /// x intervals that hold everything of the polygon in a row, rising and disjoint.
  std::vector<Span> spans(std::int64_t row) const;
  Vec2d low() const { return low_; }
  Vec2d high() const { return high_; }

  static constexpr std::size_t kMostEntries = 20'000'000;

 private:
  struct Edge {
    Vec2d a, b;
  };
  bool measure(const Polygon& shape);
  void fill(double row_height);
  template <class Visit>
  void rows_of(const Edge& edge, Visit&& visit) const;

  std::vector<Edge> edges_;
  std::vector<std::uint32_t> first_, entries_;
  double height_ = 1;
  std::int64_t row_low_ = 0;
  Vec2d low_{0, 0}, high_{0, 0};
};

/// Cells of a square grid, hashed; a cell holds a few ids.
class CellMap {
 public:
  explicit CellMap(double cell) : cell_(cell) {}
  std::int64_t index(double v) const;
  void add(const Vec2d& low, const Vec2d& high, std::uint32_t id);
  std::uint64_t cells(const Vec2d& low, const Vec2d& high) const;
  std::span<const std::uint32_t> at(const Vec2d& p) const;

 private:
  static std::uint64_t key(std::int64_t x, std::int64_t y);
  double cell_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> ids_;
};

/// Line segments with a clearance each.
class KeepClear {
 public:
  void add(const Vec2d& a, const Vec2d& b, double clearance);
  bool hit(const Vec2d& p) const;

 private:
  struct Segment {
    Vec2d a, b;
    double clearance;
  };
  std::vector<Segment> segments_;
  CellMap cells_{16};
};

/// Many polygons.
class PolygonSet {
 public:
  void add(const Polygon& shape);
  bool contains(const Vec2d& p) const;

 private:
  std::vector<PolygonRows> polygons_;
  std::vector<std::uint32_t> large_;
  CellMap cells_{32};
};

/// Points that keep a distance; open addressing over grid cells.
class PointGrid {
 public:
  explicit PointGrid(double cell);
  void insert(const Vec2d& p);
  bool any_within(const Vec2d& p, double distance) const;

 private:
  struct Slot {
    std::int32_t x = 0, y = 0;
    std::uint32_t head = 0;  // 1 + index of the newest point of the cell; 0: a free slot
  };
  std::size_t find(std::int32_t x, std::int32_t y) const;
  std::int32_t index(double v) const;
  void grow();

  double cell_;
  std::vector<Slot> slots_;
  std::size_t used_ = 0;
  std::vector<Vec2d> points_;
  std::vector<std::uint32_t> next_;
};

}  // namespace manzana::plan

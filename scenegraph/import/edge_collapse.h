#pragma once
/// Fewer triangles by edge collapse: a point is moved onto a neighbour as long as every point that there ever was stays
/// within an error of the triangles about the one that it was moved onto.
///   EdgeCollapse mesh(points, triangles);
///   mesh.run(0.1);                                       // metres; and then coarser, from where it is
///   for (const auto& t : mesh.triangles()) if (t.alive) ...
/// Points stay where they are, or go: nothing leaves the hull. What is closed stays closed; triangles keep their side.
/// Open edges, edges of more than two triangles and those between two paints keep their course within the error, and
/// where several of them meet, the point stays. What costs least by the planes about it is moved first. Time: for each
/// move the points near it times the triangles about it.
#include <array>
#include <cstdint>
#include <queue>
#include <vector>

#include "culling/vec.h"

namespace manzana {

class EdgeCollapse {
 public:
  struct Triangle {
    std::array<std::uint32_t, 3> corner;  ///< counter-clockwise from its side
    std::uint32_t paint = 0;
    bool alive = true;
  };
  /// Corners are different points below points.size().
  EdgeCollapse(std::vector<Vec3d> points, std::vector<Triangle> triangles);
  /// The point stays.
  void fix(std::uint32_t point) { fixed_[point] = true; }
  void run(double error_m);
  /// In the order that they came in.
  const std::vector<Triangle>& triangles() const { return triangles_; }
  const Vec3d& point(std::uint32_t i) const { return points_[i]; }

 private:
  struct Move {
    double rank = 0;
    std::uint32_t from = 0, to = 0;
    bool operator<(const Move& other) const { return rank > other.rank; }  // the lowest comes first
  };
  using Points = std::vector<std::uint32_t>;

  double rank(const Move& move) const;
  void propose(std::uint32_t from, std::uint32_t to);
  bool possible(const Move& move) const;
  bool keeps_sides(const Move& move) const;
  bool keeps_near(const Move& move) const;
  bool keeps_course(const Move& move) const;
  void apply(const Move& move);
  bool has(std::uint32_t triangle, std::uint32_t point) const;
  Vec3d twice_area(const std::array<std::uint32_t, 3>& corner) const;
  double distance(const Vec3d& p, const std::array<std::uint32_t, 3>& corner) const;
  bool plain(std::uint32_t a, std::uint32_t b) const;
  Points neighbours(std::uint32_t point) const;
  Points course(std::uint32_t point) const;  ///< neighbours through edges that keep their course

  std::vector<Vec3d> points_;
  std::vector<Triangle> triangles_;
  std::vector<bool> fixed_;
  std::vector<std::vector<std::uint32_t>> fan_;  // of each point: triangles that are alive
  std::vector<Points> stands_for_;               // of each point: those that were moved onto it, and itself
  std::vector<bool> on_course_;                  // of each point, as it was at first
  std::priority_queue<Move> moves_;
  double error_ = 0;
};

}  // namespace manzana

// Oriented boxes against Eigen's eigenvectors and CGAL's smallest box.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/optimal_bounding_box.h>

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cmath>

#include "foliage/obb_cells.h"
#include "point_sets.h"

namespace manzana::foliage {

TEST_CASE("the axes of a box are Eigen's eigenvectors") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Points set = random_points(500, {1, .4, .04}, some_turn(), {676000, 4.6e6, 200}, seed);
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const Vec3d& p : set) middle += Eigen::Vector3d(p.x, p.y, p.z) / 500;
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const Vec3d& p : set) {
      const Eigen::Vector3d d = Eigen::Vector3d(p.x, p.y, p.z) - middle;
      sum += d * d.transpose();
    }
    const Eigen::Matrix3d v = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>().compute(sum).eigenvectors();
    const OrientedBox box = fit_box(set);
    for (int k = 0; k < 3; ++k) {
      double along = 0;
      for (int i = 0; i < 3; ++i) along += v(i, 2 - k) * static_cast<double>(box.axes[k][i]);
      CHECK(std::abs(along) == Approx(1).margin(1e-6));
    }
  }
}

TEST_CASE("a box of leaves is near the smallest that CGAL finds") {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Points set = random_points(500, {1, .4, .04}, some_turn(), {}, seed);
    std::vector<Kernel::Point_3> points;
    for (const Vec3d& p : set) points.emplace_back(p.x, p.y, p.z);
    std::array<Kernel::Point_3, 8> best;
    CGAL::oriented_bounding_box(points, best, CGAL::parameters::use_convex_hull(true));
    const double least = std::sqrt(CGAL::squared_distance(best[0], best[1]) * CGAL::squared_distance(best[0], best[3]) *
                                   CGAL::squared_distance(best[0], best[5]));
    INFO("ratio " << volume(fit_box(set)) / least);
    CHECK(volume(fit_box(set)) <= 1.3 * least);
  }
}

}  // namespace manzana::foliage

// How tight the spheres of inner nodes are, against the smallest sphere round the spheres of the leaves [numerics 3].
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/Simple_cartesian.h>

#include <catch2/catch.hpp>
#include <iostream>

#include "tests/culling/city.h"

namespace manzana::culling::test {
namespace {

using Traits = CGAL::Min_sphere_of_spheres_d_traits_3<CGAL::Simple_cartesian<double>, double>;
using Smallest = CGAL::Min_sphere_of_spheres_d<Traits>;

double smallest_radius(const BqrTree& tree, const City& city, const BqrNode& node) {
  std::vector<Traits::Sphere> spheres;
  for (std::uint32_t leaf = node.first; leaf < node.last; ++leaf) {
    const SphereD& s = city.blocks[tree.order[leaf]].sphere;
    spheres.emplace_back(Traits::Point(s.center.x, s.center.y, s.center.z), s.radius);
  }
  return Smallest(spheres.begin(), spheres.end()).radius();
}

/// Of each node: the longest way down to a leaf.
std::vector<std::size_t> heights(const BqrTree& tree) {
  std::vector<std::size_t> height(tree.nodes.size(), 0);
  for (std::uint32_t i = static_cast<std::uint32_t>(tree.nodes.size()); i-- > 0;)
    for (std::uint32_t child = i + 1; child < tree.nodes[i].skip; child = tree.nodes[child].skip)
      height[i] = std::max(height[i], height[child] + 1);
  return height;
}

/// Blocks of uneven density: towards the middle they are smaller and closer.
City uneven_city(std::uint64_t seed, int blocks) {
  Random random(seed);
  City city;
  for (int i = 0; i < blocks; ++i) {
    const double spread = random.scale(100, 5000), size = random.in(0.05, 0.1) * spread + 15;
    const Vec3d c = Vec3d{random.in(-1, 1), random.in(-1, 1), 0} * spread;
    const BoxD box{c - Vec3d(size, size, 0), c + Vec3d(size, size, random.in(4, 60))};
    city.blocks.push_back({Vec2d(c), box, enclosing_sphere(box)});
  }
  return city;
}

TEST_CASE("inner spheres are nearly the smallest") {
  struct Ratio {
    double sum = 0, most = 0;
    int n = 0;
  };
  std::vector<Ratio> by_height(40);
  for (std::uint64_t seed = 51; seed < 61; ++seed) {
    const City city = seed % 2 == 0 ? make_city(32, 2, seed) : uneven_city(seed, 1024);
    const BqrTree tree = build_bqr_tree(city.blocks);
    const auto height = heights(tree);
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
      if (tree.nodes[i].leaf()) continue;
      const double r = static_cast<double>(tree.nodes[i].bounds.radius) / smallest_radius(tree, city, tree.nodes[i]);
      REQUIRE(r >= 1 - 1e-9);
      Ratio& at = by_height[height[i]];
      at = {at.sum + r, std::max(at.most, r), at.n + 1};
    }
  }
  for (std::size_t h = 1; h < by_height.size() && by_height[h].n > 0; ++h) {
    const Ratio& at = by_height[h];
    std::cout << "height " << h << ": " << at.n << " nodes, R/Ropt mean " << at.sum / at.n << " max " << at.most
              << '\n';
    CHECK(at.sum / at.n <= 1.07);
    CHECK(at.most <= 1.20);
  }
  CHECK(by_height[4].n > 0);
}

}  // namespace
}  // namespace manzana::culling::test

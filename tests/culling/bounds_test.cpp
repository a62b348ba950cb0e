// How tight the spheres of inner nodes are, against the smallest sphere round the spheres of the leaves [numerics 3].
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/Simple_cartesian.h>

#include <catch2/catch.hpp>
#include <iostream>

#include "culling/baselines/cases.h"
#include "culling/baselines/random.h"

namespace manzana::culling::test {
namespace {

using baselines::City;
using baselines::Random;
using Traits = CGAL::Min_sphere_of_spheres_d_traits_3<CGAL::Simple_cartesian<double>, double>;
using Smallest = CGAL::Min_sphere_of_spheres_d<Traits>;

double smallest_radius(const BqrTree& tree, const City& city, const BqrNode& node, std::uint32_t lane) {
  std::vector<Traits::Sphere> spheres;
  for (std::uint32_t block = node.first_block[lane]; block < node.last_block[lane]; ++block) {
    const SphereD& s = city.blocks[tree.order[block]].sphere;
    spheres.emplace_back(Traits::Point(s.center.x, s.center.y, s.center.z), s.radius);
  }
  return Smallest(spheres.begin(), spheres.end()).radius();
}

/// Of each node: the longest way down to a block.
std::vector<std::size_t> heights(const BqrTree& tree) {
  std::vector<std::size_t> height(tree.nodes.size(), 1);
  for (std::size_t i = tree.nodes.size(); i-- > 1;)
    height[tree.nodes[i].parent] = std::max(height[tree.nodes[i].parent], height[i] + 1);
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

struct Ratio {
  double sum = 0, most = 0;
  int n = 0;
};

void add_lanes(const BqrTree& tree, const City& city, std::vector<Ratio>& by_height) {
  const auto height = heights(tree);
  for (std::size_t i = 0; i < tree.nodes.size(); ++i)
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const BqrNode& node = tree.nodes[i];
      if ((node.lanes >> lane & 1) == 0 || (node.blocks >> lane & 1) != 0) continue;
      const double r = lane_sphere(node, lane).radius / smallest_radius(tree, city, node, lane);
      REQUIRE(r >= 1 - 1e-9);
      Ratio& at = by_height[height[node.child[lane]]];
      at = {at.sum + r, std::max(at.most, r), at.n + 1};
    }
}

TEST_CASE("inner spheres are nearly the smallest") {
  std::vector<Ratio> by_height(40);
  for (std::uint64_t seed = 51; seed < 61; ++seed) {
    const City city = seed % 2 == 0 ? baselines::make_city(102'400, seed) : uneven_city(seed, 4096);
    add_lanes(build_bqr_tree(city.blocks), city, by_height);
  }
  for (std::size_t h = 1; h < by_height.size() && by_height[h].n > 0; ++h) {
    const Ratio& at = by_height[h];
    std::cout << "height " << h << ": " << at.n << " nodes, R/Ropt mean " << at.sum / at.n << " max " << at.most
              << '\n';
    CHECK(at.sum / at.n <= 1.07);
    CHECK(at.most <= 1.20);
  }
  CHECK(by_height[2].n > 0);
}

}  // namespace
}  // namespace manzana::culling::test

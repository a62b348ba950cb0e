#pragma once
/// Points that stand for leaves. [Deussen 2005, section 10.3; Gadbem 2011, section 3.5]
///   QuadPoints points(plant.leaf_image);
///   for (const PlantQuad& quad : quads) append(cloud, points.four(quad, Organ::leaf));
///   for (const PointCloud& coarser : merged_levels(cloud)) ...
/// A point hides, from anywhere, half of what the triangle under it has of leaf: the mean over all directions.
#include <memory>
#include <span>

#include "foliage/plant.h"
#include "foliage/prepared_plant.h"

namespace manzana::foliage {

/// A LeafPoint with full floats, for merging.
struct CloudPoint {
  Vec3 position{0};
  float area = 0;  ///< as in LeafPoint
  Vec3 normal{0};  ///< of any length
  float shade = 1;
  Vec3 colour{0};           ///< linear
  float square = 0;         ///< mean of the squares of luminance() times arriving(shade)
  std::uint32_t level = 0;  ///< of the branch, at most 3
  Organ organ = Organ::leaf;
};
using PointCloud = std::vector<CloudPoint>;

LeafPoint packed(const CloudPoint& point);

/// Two for each triangle of the quad, one in each half of it, at the middle of what alpha leaves of the half, with its
/// colour; four for a quad that is one triangle. So always four, some of them perhaps without area.
/// The same for quads whose uv are the same; those are looked up.
class QuadPoints {
 public:
  explicit QuadPoints(const Image& image);
  ~QuadPoints();
  std::array<CloudPoint, 4> four(const PlantQuad& quad, Organ organ);
  /// Spread by Poisson disks, in an order of which any first few are spread: for large leaves. Those on air are
  /// left out; the sum of area is that of four().
  PointCloud many(const PlantQuad& quad, Organ organ, std::uint32_t count, std::uint64_t seed);

 private:
  struct Table;
  std::unique_ptr<Table> table_;
};

/// The order of a tree of halves: each cut is across the longest side, at the median, and after a multiple of four; so
/// every four in a row from the start are near each other. [Bentley 1975, k-d trees]
std::vector<std::uint32_t> spatial_order(std::span<const Vec3> positions);

/// The order in which every prefix is spread: takes from the halves of the spatial order in turn, from the halves of
/// these in turn, and so on.  [van der Corput 1935]
std::vector<std::uint32_t> progressive_order(std::span<const Vec3> positions);

/// Four neighbours to one: sum of area; mean by area of all else. Points of more than `large` m2 pass as they are.
/// Points without area are dropped.
PointCloud merged(const PointCloud& cloud, float large);

/// The levels above a finest one, each in progressive order, until few points are left. Flowers and fruit are one
/// merging behind the leaves.
std::vector<PointCloud> merged_levels(const PointCloud& finest);

}  // namespace manzana::foliage

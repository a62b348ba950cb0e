#pragma once
/// What each visible tree shows: the twin, on the CPU, of what foliage/gl does on the GPU, to the bit. It is the oracle
/// of the GPU's work, and stands in where there is none.
///   PlantTable table = make_plant_table(plants);                    // once
///   table.details = make_details(plants, law);                      // foliage/detail.h
///   Selection chosen;
///   select(table, {sites, block_rows, runs, error_px / focal_px}, chosen);  // each frame
#include <array>
#include <span>
#include <vector>

#include "culling/frustum.h"
#include "foliage/plant_table.h"

namespace manzana::foliage {

/// `height_m` and `crown_radius_m`: what the copy measures. `id` makes what is random about it.
TreeSite make_site(const PreparedPlant& plant, std::uint32_t index, float height_m, float crown_radius_m, float yaw,
                   std::uint64_t id);

/// What is drawn: for every tree, in the order of the runs, its record and kFixedItems items; then, in the same order,
/// an item for each cell of those that show leaf quads.
struct Selection {
  std::vector<TreeRecord> trees;
  std::vector<Item> items;
};

/// Planes: what is seen lies where dot(xyz, p) + w >= 0, relative to the eye. Cells beyond one are left out.
using ViewSides = std::array<Vec4, glsl::kViewSides>;
inline constexpr ViewSides kAllAround{Vec4{0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}};
/// Of a frustum, as it is seen from an eye, which need not be its own (draw/camera.h).
ViewSides sides_of(const culling::FrustumD& frustum, const Vec3d& eye);

/// What is in view, and how exactly it is wanted.
struct TreesSeen {
  std::span<const TreeSite> sites;
  std::span<const Vec4> block_rows;  ///< three a block, relative to the eye; those of visible blocks count
  std::span<const Run> runs;         ///< of sites
  double error_at_1m = 0.001;   ///< metres that may be wrong a metre away: error in pixels / focal length in pixels
  bool heed_neighbours = true;  ///< more may be wrong of what they hide: foliage/neighbours.h
  ViewSides sides = kAllAround;
};
void select(const PlantTable& table, const TreesSeen& seen, Selection& selection);

/// What a plant shows where the square of so much may be wrong: between the two rows of its table.
Detail detail_at(const PlantTable& table, std::uint32_t plant, float error2);

/// As the shader has it.
float error2_at_1m(double error_at_1m);

/// The square of what may be wrong of a tree, and where its middle is, relative to the eye.
struct TreeError {
  float error2;
  Vec3 middle;
};
TreeError error_of_tree(const PlantTable& table, const TreesSeen& seen, std::uint32_t site);

/// Primitives: bark and leaf quads, lines, points.
struct Shown {
  std::uint64_t bark = 0, leaves = 0, lines = 0, points = 0;
  std::uint64_t missing = 0;  ///< items and groups that lists had no room for: parts of trees that are not drawn
};
Shown count_shown(const Selection& selection);

}  // namespace manzana::foliage

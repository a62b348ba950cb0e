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

#include "foliage/prepared_plant.h"

namespace manzana::foliage {

namespace glsl {
using uint = std::uint32_t;
using vec2 = glm::vec2;
using vec3 = glm::vec3;
using vec4 = glm::vec4;
using uvec3 = glm::uvec3;
using uvec4 = glm::uvec4;
#include "foliage/shaders/select_layout.glsl"
}  // namespace glsl
using glsl::CellHead;
using glsl::Detail;
using glsl::Item;
using glsl::PlantHead;
using glsl::TreeRecord;
using glsl::TreeSite;
static_assert(sizeof(TreeSite) == 48 && sizeof(Detail) == 48 && sizeof(PlantHead) == 400 && sizeof(CellHead) == 32 &&
              sizeof(TreeRecord) == 64 && sizeof(Item) == 32);

/// All plants of a scene as the buffers have them: heads, cells, branch steps, visibility; and how much each shows, a
/// table of kDetailSteps rows a plant.
struct PlantTable {
  std::vector<PlantHead> plants;
  std::vector<CellHead> cells;
  std::vector<glm::uvec2> steps;     ///< quads, first line
  std::vector<std::uint32_t> views;  ///< PreparedPlant::visibility, four bytes a word
  std::vector<Detail> details;
};

/// Quads are numbered as the buffers hold them: of each plant its bark, then its leaves. Throws std::invalid_argument
/// for more than kMostLevels levels of branches, kMostPointLevels of points.
PlantTable make_plant_table(std::span<const PreparedPlant> plants);

/// `height_m` and `crown_radius_m`: what the copy measures. `id` makes what is random about it.
TreeSite make_site(const PreparedPlant& plant, std::uint32_t index, float height_m, float crown_radius_m, float yaw,
                   std::uint64_t id);

/// What is drawn: for every tree, in the order of the runs, its record and kFixedItems items; then, in the same order,
/// an item for each cell of those that show leaf quads.
struct Selection {
  std::vector<TreeRecord> trees;
  std::vector<Item> items;
};

/// What is in view, and how exactly it is wanted.
struct TreesSeen {
  std::span<const TreeSite> sites;
  std::span<const Vec4> block_rows;  ///< three a block, relative to the eye; those of visible blocks count
  std::span<const Run> runs;         ///< of sites
  double error_at_1m = 0.001;  ///< metres that may be wrong a metre away: error in pixels / focal length in pixels
};
void select(const PlantTable& table, const TreesSeen& seen, Selection& selection);

/// What a plant shows where the square of so much may be wrong: between the two rows of its table.
Detail detail_at(const PlantTable& table, std::uint32_t plant, float error2);

/// As the shader has it.
float error2_at_1m(double error_at_1m);

/// Primitives: bark and leaf quads, lines, points.
struct Shown {
  std::uint64_t bark = 0, leaves = 0, lines = 0, points = 0;
  std::uint64_t missing = 0;  ///< items and groups that lists had no room for: parts of trees that are not drawn
};
Shown count_shown(const Selection& selection);

}  // namespace manzana::foliage

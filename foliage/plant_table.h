#pragma once
/// All plants of a scene as the GPU's buffers have them, and as its shaders read them (foliage/shaders/select.glsl).
///   PlantTable table = make_plant_table(plants);
///   table.details = make_details(plants, law);                      // foliage/detail.h
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
static_assert(sizeof(TreeSite) == 80 && sizeof(Detail) == 48 && sizeof(PlantHead) == 400 && sizeof(CellHead) == 32 &&
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

/// Share of the ellipse of its height and width that a plant hides, seen from its sides: PlantHead::density.
float density_of(const PreparedPlant& plant);

std::uint32_t leaf_quads(const PlantTable& table, const PlantHead& plant);

/// Of a level, those of branches from `branch` on; the coarsest level stands for those beyond it.
std::uint32_t lines_from(const PlantTable& table, const PlantHead& plant, std::uint32_t level, std::uint32_t branch);
std::uint32_t leaf_lines(const PlantTable& table, const PlantHead& plant, std::uint32_t level);  ///< of thin leaves

}  // namespace manzana::foliage

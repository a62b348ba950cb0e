#include "scenegraph/export/plant_model.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "foliage/detail.h"
#include "foliage/leaf_image.h"

namespace manzana {
namespace {

using namespace foliage;

Vec3 normal_of(std::uint32_t packed) { return glm::normalize(Vec3(glm::unpackSnorm3x10_1x2(packed))); }

/// Linear, of the opaque texels.
Vec3 mean_colour(const Image& image) {
  Vec3 sum(0);
  float weight = 0;
  for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4) {
    const auto alpha = static_cast<float>(image.rgba[i + 3]);
    sum += alpha *
           Vec3(linear_of_srgb(image.rgba[i]), linear_of_srgb(image.rgba[i + 1]), linear_of_srgb(image.rgba[i + 2]));
    weight += alpha;
  }
  return weight > 0 ? sum / weight : Vec3(0.2F);
}

void add_quad(TileMesh& mesh, const std::array<Vec3, 4>& corners, const std::array<Vec3, 4>& normals,
              const std::array<Vec3, 4>& colours) {
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  for (std::size_t k = 0; k < 4; ++k) mesh.vertices.push_back({corners[k], normals[k], colours[k], 0});
  for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(base + i);
}

void add_bark(TileMesh& mesh, const PlantQuad& quad, const Vec3& colour) {
  std::array<Vec3, 4> corners, normals, colours;
  for (std::size_t k = 0; k < 4; ++k) {
    corners[k] = quad.corners[k].position;
    normals[k] = normal_of(quad.normals[k]);
    colours[k] = colour * (static_cast<float>(quad.shades[k]) / 255);
  }
  add_quad(mesh, corners, normals, colours);
}

/// A unit vector at right angles to a unit vector.
Vec3 across(const Vec3& v) {
  return glm::normalize(glm::cross(v, std::abs(v.z) < 0.8F ? Vec3(0, 0, 1) : Vec3(1, 0, 0)));
}

/// A flat card hides half of its area on average over all directions, a point all of it: so twice the area. [Cauchy]
void add_card(TileMesh& mesh, const LeafPoint& point) {
  const Vec3 normal = normal_of(point.normal), u = across(normal) * std::sqrt(2 * point.area) * 0.5F,
             v = glm::cross(normal, u);
  const std::uint32_t c = point.colour;
  const Vec3 colour = linear_of_rgb((c & 255U) << 16 | (c & 0xff00U) | (c >> 16 & 255U)) * std::min(point.shade, 1.0F);
  const Vec3 p = point.position;
  add_quad(mesh, {p - u - v, p + u - v, p + u + v, p - u + v}, {normal, normal, normal, normal},
           {colour, colour, colour, colour});
}

/// The same of ribbons about their line.
void add_ribbon(TileMesh& mesh, const LineSegment& line, const Vec3& bark) {
  constexpr float kWider = 1.57F;
  const Vec3 along = line.b - line.a;
  if (!(glm::length(along) > 0)) return;
  const Vec3 side = across(glm::normalize(along)) * kWider, normal = glm::normalize(glm::cross(side, along));
  const Vec3 colour = bark * line.shade, a = line.radius_a * side, b = line.radius_b * side;
  add_quad(mesh, {line.a - a, line.a + a, line.b + b, line.b - b}, {normal, normal, normal, normal},
           {colour, colour, colour, colour});
}

/// The branches that are meshes: of the level, without those that have turned into lines on the way to the next.
/// [branch_step() of foliage/shaders/select.glsl]
BranchStep step_of(const PreparedPlant& plant, const BranchLevel& level, float way) {
  const std::uint32_t last = level.steps.size() - 1;
  const auto gone = static_cast<std::uint32_t>(std::min(way, 1.0F) * static_cast<float>(last));
  return plant.branch_steps[level.steps.first + last - std::min(gone, last)];
}

void add_branches(TileMesh& mesh, const PreparedPlant& plant, const Detail& detail) {
  if (plant.branch_levels.empty()) return;
  const Vec3 colour = mean_colour(plant.bark_image);
  const auto index = std::min(static_cast<std::size_t>(detail.bark), plant.branch_levels.size() - 1);
  const BranchLevel& level = plant.branch_levels[index];
  const BranchStep step = step_of(plant, level, detail.bark - static_cast<float>(index));
  for (std::uint32_t i = 0; i < step.quads; ++i) add_bark(mesh, plant.bark[level.quads.first + i], colour);
  const std::size_t lines = std::min(static_cast<std::size_t>(detail.line_level + 0.5F), plant.line_levels.size()),
                    row = lines * (plant.branch_levels.front().branches + 2);
  const std::uint32_t first = plant.line_firsts[row + step.branches],
                      last = plant.line_firsts[row + plant.branch_levels.front().branches];
  const auto& list = lines == 0 ? plant.lines : plant.coarse_lines;
  const auto shown = static_cast<std::uint32_t>(static_cast<float>(last - first) * detail.lines);
  for (std::uint32_t i = first; i < first + shown; ++i) add_ribbon(mesh, list[i], colour);
}

void add_leaves(TileMesh& mesh, const PreparedPlant& plant, const Detail& detail) {
  if (plant.point_levels.empty()) return;
  const auto level = std::min(static_cast<std::size_t>(detail.point_level + 0.5F), plant.point_levels.size() - 1);
  const Run run = plant.point_levels[level].points;
  for (std::uint32_t i = run.first; i < run.last; ++i) add_card(mesh, plant.points[i]);
}

}  // namespace

PlantModels::PlantModels(std::span<const PreparedPlant> plants) : plants_(plants), table_(make_plant_table(plants)) {
  table_.details = make_details(plants, Law::ours);
}

TileMesh PlantModels::at(std::uint16_t plant, double error_m) const {
  TileMesh mesh;
  const Detail detail = detail_at(table_, plant, static_cast<float>(error_m * error_m));
  add_branches(mesh, plants_[plant], detail);
  add_leaves(mesh, plants_[plant], detail);
  return mesh;
}

}  // namespace manzana

#include "foliage/branch_levels.h"

#include <algorithm>

#include "foliage/plant_quads.h"

namespace manzana::foliage {
namespace {

float mean_shade(const Plant& plant, const Branch& branch) {
  const auto& bark = plant.mesh.bark;
  float sum = 0;
  for (std::size_t i = 3 * std::size_t{branch.triangles.first}; i < 3 * std::size_t{branch.triangles.last}; ++i)
    sum += bark.vertices[bark.indices[i]].shade;
  return branch.triangles.size() == 0 ? 1 : sum / (3 * static_cast<float>(branch.triangles.size()));
}

void add_lines(const Plant& plant, std::uint32_t row, std::vector<LineSegment>& out) {
  const Branch& branch = plant.branches[row];
  const float shade = mean_shade(plant, branch);
  for (std::uint32_t i = branch.line.first; i + 1 < branch.line.last; ++i) {
    const CentrePoint &a = plant.centre_lines[i], &b = plant.centre_lines[i + 1];
    out.push_back({a.position, a.radius, b.position, b.radius, shade, branch.level, row});
  }
}

void add_branch_quads(const Plant& plant, const Branch& branch, std::vector<PlantQuad>& out) {
  const Vec3 foot = branch.line.size() > 0 ? plant.centre_lines[branch.line.first].position : Vec3(0);
  const std::span indices(plant.mesh.bark.indices);
  add_quads(plant.mesh.bark,
            indices.subspan(3 * std::size_t{branch.triangles.first}, 3 * std::size_t{branch.triangles.size()}),
            {foot, branch.level}, out);
}

}  // namespace

void prepare_branches(const Plant& plant, const PrepareOptions&, PreparedPlant& ready) {
  ready.bark.clear(), ready.lines.clear(), ready.branch_levels.clear(), ready.branch_steps.clear();
  const auto step = [&] {
    return BranchStep{static_cast<std::uint32_t>(ready.bark.size()), static_cast<std::uint32_t>(ready.lines.size())};
  };
  ready.branch_steps.push_back(step());
  for (std::uint32_t row = 0; row < plant.branches.size(); ++row) {
    add_lines(plant, row, ready.lines);
    add_branch_quads(plant, plant.branches[row], ready.bark);
    ready.branch_steps.push_back(step());
  }
  BranchLevel level;
  level.quads = {0, step().quads};
  level.branches = static_cast<std::uint32_t>(plant.branches.size());
  level.first_line = step().first_line;
  level.steps = {0, level.branches + 1};
  ready.branch_levels.push_back(level);
}

BranchStep branch_step(const PreparedPlant& plant, std::size_t level, float t) {
  const Run& steps = plant.branch_levels[level].steps;
  const float part = t > 0 ? std::min(t, 1.0F) : 0;
  return plant.branch_steps[steps.last - 1 - static_cast<std::uint32_t>(part * static_cast<float>(steps.size() - 1))];
}

}  // namespace manzana::foliage

#include "foliage/branch_levels.h"

#include <algorithm>

#include "foliage/branch_order.h"
#include "foliage/line_levels.h"
#include "foliage/plant_quads.h"
#include "foliage/random.h"
#include "foliage/reduce_branch.h"

namespace manzana::foliage {
namespace {

constexpr double kKept = 0.5;  // of the triangles, from level to level
// What the mesh may be off: of the level's error, and of a branch's own width, or the thinnest would lose their form.
constexpr float kReduction = 0.25F, kOfWidth = 0.05F;

std::uint32_t size_of(const auto& rows) { return static_cast<std::uint32_t>(rows.size()); }

class Builder {
 public:
  Builder(const Plant& plant, const PrepareOptions& options, PreparedPlant& ready)
      : plant_(plant), options_(options), ready_(ready) {}

  void run() {
    ready_.bark.clear(), ready_.lines.clear(), ready_.branch_levels.clear(), ready_.branch_steps.clear();
    ready_.coarse_lines.clear(), ready_.line_levels.clear();
    for (const Branch& branch : plant_.branches) shapes_.push_back(branch_shape(plant_, branch));
    order_ = importance_order(plant_, shapes_, options_.branch_order);
    choose_sizes();
    for (std::size_t l = 0; l < sizes_.size(); ++l) shuffle(next_size(l), sizes_[l]);
    add_lines();
    ready_.line_firsts = first_lines_;
    add_line_levels(plant_, shapes_, order_, ready_);
    for (std::size_t l = 0; l < sizes_.size(); ++l) add_level(l);
  }

 private:
  /// How many branches each level keeps as a mesh.
  void choose_sizes() {
    sizes_.push_back(size_of(order_));
    double share = kKept;
    for (std::uint32_t l = 1; l < options_.branch_levels; ++l, share *= kKept) {
      const auto most = static_cast<std::uint64_t>(share * static_cast<double>(plant_.mesh.bark.triangles()));
      const std::uint32_t size = first_within(most);
      if (size > 0 && size < sizes_.back()) sizes_.push_back(size);
    }
  }

  std::uint32_t first_within(std::uint64_t triangles) const {
    std::uint64_t sum = 0;
    for (std::uint32_t i = 0; i < order_.size(); ++i)
      if ((sum += plant_.branches[order_[i]].triangles.size()) > triangles) return i;
    return size_of(order_);
  }

  std::uint32_t next_size(std::size_t level) const { return level + 1 < sizes_.size() ? sizes_[level + 1] : 0; }

  void shuffle(std::uint32_t first, std::uint32_t last) {
    const auto key = [&](std::uint32_t row) { return std::pair(hash(options_.seed, row), row); };
    std::sort(order_.begin() + first, order_.begin() + last, [&](auto a, auto b) { return key(a) < key(b); });
  }

  void add_lines() {
    for (const std::uint32_t row : order_) {
      first_lines_.push_back(size_of(ready_.lines));
      const BranchShape& shape = shapes_[row];
      for (std::size_t i = 0; i + 1 < shape.line.size(); ++i) {
        const CentrePoint &a = shape.line[i], &b = shape.line[i + 1];
        ready_.lines.push_back(
            {a.position, a.radius, b.position, b.radius, shape.visibility, plant_.branches[row].level, row});
      }
    }
    first_lines_.insert(first_lines_.end(), 2, size_of(ready_.lines));
  }

  float widest_line(std::uint32_t first) const {
    float width = 0;
    for (std::size_t i = first; i < order_.size(); ++i) width = std::max(width, shapes_[order_[i]].width_m);
    return width;
  }

  void add_level(std::size_t l) {
    BranchLevel level;
    level.branches = sizes_[l];
    level.first_line = first_lines_[sizes_[l]];
    level.error_m = widest_line(sizes_[l]);
    level.quads.first = size_of(ready_.bark);
    level.steps.first = size_of(ready_.branch_steps);
    for (std::uint32_t i = 0; i <= sizes_[l]; ++i) {
      if (i >= next_size(l))
        ready_.branch_steps.push_back({size_of(ready_.bark) - level.quads.first, first_lines_[i], i});
      if (i < sizes_[l]) add_quads_of(order_[i], level);
    }
    level.quads.last = size_of(ready_.bark);
    level.steps.last = size_of(ready_.branch_steps);
    ready_.branch_levels.push_back(level);
  }

  void add_quads_of(std::uint32_t row, BranchLevel& level) {
    const Branch& branch = plant_.branches[row];
    const std::vector<CentrePoint>& line = shapes_[row].line;
    const QuadTraits traits{line.empty() ? Vec3(0) : line.front().position, branch.level};
    const float error = std::min(kReduction * level.error_m, kOfWidth * shapes_[row].width_m);
    const MeshPart whole = branch_part(plant_, branch);
    const Reduced mesh = level.error_m > 0 ? reduced_branch(whole, line, error) : Reduced{whole, 0};
    level.mesh_error_m = std::max(level.mesh_error_m, mesh.error_m);
    add_quads(mesh.part, mesh.part.indices, traits, ready_.bark);
  }

  const Plant& plant_;
  const PrepareOptions& options_;
  PreparedPlant& ready_;
  std::vector<BranchShape> shapes_;
  std::vector<std::uint32_t> order_, sizes_, first_lines_;
};

}  // namespace

void prepare_branches(const Plant& plant, const PrepareOptions& options, PreparedPlant& ready) {
  Builder(plant, options, ready).run();
}

BranchStep branch_step(const PreparedPlant& plant, std::size_t level, float t) {
  const BranchLevel& pair = plant.branch_levels[level];
  const Run& steps = pair.steps;
  if (steps.size() == 0) return {pair.quads.size(), pair.first_line, pair.branches};
  const float part = t > 0 ? std::min(t, 1.0F) : 0;
  return plant.branch_steps[steps.last - 1 - static_cast<std::uint32_t>(part * static_cast<float>(steps.size() - 1))];
}

}  // namespace manzana::foliage

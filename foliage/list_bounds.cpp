#include "foliage/list_bounds.h"

#include <algorithm>
#include <cmath>

namespace manzana::foliage {
namespace {

/// What rounding of floats may add.
constexpr double kSlack = 1e-3;
/// More leaves are shown where some shrink away: select.glsl, cell_item().
const double kMostShrinking = 1 + static_cast<double>(glsl::kLeafFade) / 2;

double groups(double primitives, std::uint32_t size) { return std::ceil(primitives / size); }

/// A plant's steps from the finest on, as select.glsl's branch_step() passes through them.
struct BranchSteps {
  std::vector<glm::uvec2> steps;
  std::vector<std::uint32_t> first;  ///< of each level

  BranchSteps(const PlantTable& table, const PlantHead& plant) {
    for (std::uint32_t level = 0; level < plant.bark_levels; ++level) {
      first.push_back(static_cast<std::uint32_t>(steps.size()));
      const auto begin = table.steps.begin() + plant.first_step + plant.bark[level].y;
      steps.insert(steps.end(), std::reverse_iterator(begin + plant.bark[level].z), std::reverse_iterator(begin));
    }
    first.push_back(static_cast<std::uint32_t>(steps.size()));
  }
  std::size_t at(float bark) const {
    const auto level = std::min(static_cast<std::size_t>(bark), first.size() - 2);
    const std::uint32_t last = first[level + 1] - first[level] - 1;
    const float gone = std::min(bark - static_cast<float>(level), 1.0F) * static_cast<float>(last);
    return first[level] + std::min(static_cast<std::uint32_t>(gone), last);
  }
};

/// Two neighbouring levels of lines, of which the coarser shows the branches of the first ranks, the finer the others.
class LineMixtures {
 public:
  LineMixtures(const PlantTable& table, const PlantHead& plant) : table_(table), plant_(plant) {
    for (std::uint32_t fine = 0; fine + 1 < plant.line_levels; ++fine) {
      std::vector<double> more(plant.branches + 1, 0.0);
      for (std::uint32_t rank = plant.branches; rank-- > 0;) more[rank] = std::max(more[rank + 1], gain(fine, rank));
      more_.push_back(std::move(more));
    }
  }
  /// Of branches from `branch` on, wherever the coarser's end.
  double most(std::uint32_t fine, std::uint32_t branch) const {
    return lines(fine, branch) + (fine < more_.size() ? more_[fine][branch] - gain(fine, branch) : 0);
  }

 private:
  double lines(std::uint32_t level, std::uint32_t branch) const { return lines_from(table_, plant_, level, branch); }
  /// What the mixture has more than the finer level alone, but for a constant, where the coarser's end at this rank.
  double gain(std::uint32_t fine, std::uint32_t rank) const { return lines(fine, rank) - lines(fine + 1, rank); }

  const PlantTable& table_;
  const PlantHead& plant_;
  std::vector<std::vector<double>> more_;  ///< a level, a rank: the most gain from there on
};

/// Of the levels that these details may choose. Where leaves' lines are shown, branches' are all.
double most_lines(const PlantTable& table, const PlantHead& plant, const LineMixtures& mixtures, const Detail& a,
                  const Detail& b, std::uint32_t branch) {
  const auto [low, high] = std::minmax({a.line_level, b.line_level});
  const std::uint32_t coarsest = std::max(plant.line_levels, 1U) - 1;
  const auto share = static_cast<double>(std::max(a.lines, b.lines)),
             turned = static_cast<double>(std::max(a.to_lines, b.to_lines)) *
                      (1 - static_cast<double>(std::min(a.to_points, b.to_points)));
  double most = 0;
  for (auto l = std::min(static_cast<std::uint32_t>(low), coarsest);
       l <= std::min(static_cast<std::uint32_t>(high), coarsest); ++l) {
    const double leaves = std::max(leaf_lines(table, plant, l), leaf_lines(table, plant, l + 1)) * turned;
    most = std::max(most, mixtures.most(l, branch) * (turned > 0 || l < coarsest ? 1 : share) +
                              (leaves > 0 ? leaves * (1 + kSlack) + 1 : 0));
  }
  return most;
}

ListSizes branches_between(const PlantTable& table, const PlantHead& plant, const BranchSteps& branches,
                           const LineMixtures& mixtures, const Detail& a, const Detail& b) {
  const auto lines = [&](std::uint32_t from) {
    return groups(most_lines(table, plant, mixtures, a, b, from), glsl::kLineGroup);
  };
  if (branches.steps.empty()) return {0, 0, lines(0), 0};
  const auto [from, to] = std::minmax({branches.at(a.bark), branches.at(b.bark)});
  std::uint32_t quads = 0, meshes = ~0U;
  for (std::size_t i = from; i <= to; ++i) {
    quads = std::max(quads, branches.steps[i].x);
    meshes = std::min(meshes, branches.steps[i].y);
  }
  return {0, groups(quads, glsl::kQuadGroup), lines(meshes), 0};
}

/// How many of the coarser of two levels are shown at most: all, where the levels change in between.
double coarse_points(const PlantHead& plant, const Detail& a, const Detail& b) {
  const auto level = [&](const Detail& d) { return std::min(std::floor(d.point_level), plant.point_levels - 1.0F); };
  const float finest = std::min(level(a), level(b));
  const auto coarse = std::min(static_cast<std::uint32_t>(finest) + 1, plant.point_levels - 1);
  const float x = level(a) == level(b) ? std::max(a.point_level, b.point_level) - finest : 1;
  return static_cast<double>(x) * plant.points[coarse].y;
}

/// In two items, each with a point more by chance, and a group that is not full: at most one group more.
ListSizes points_between(const PlantHead& plant, const Detail& a, const Detail& b) {
  const auto share = static_cast<double>(std::max(a.to_points, b.to_points));
  if (plant.point_levels == 0 || share <= 0) return ListSizes(0);
  const double coarse = coarse_points(plant, a, b);
  const auto fade = static_cast<double>(glsl::kPointFade);
  const double points = (1 + fade) * std::max(static_cast<double>(std::max(a.points, b.points)), coarse);
  return {0, 0, 0, points * share * (1 + kSlack) / glsl::kPointGroup + (coarse > 0 ? 2 : 1)};
}

void add_others(const PlantTable& table, const PlantHead& plant, const Detail* rows, ListSizes* out) {
  const BranchSteps branches(table, plant);
  const LineMixtures mixtures(table, plant);
  for (std::size_t row = 0; row < glsl::kDetailSteps; ++row) {
    const Detail &a = rows[row], &b = rows[std::min<std::size_t>(row + 1, glsl::kDetailSteps - 1)];
    out[row] = branches_between(table, plant, branches, mixtures, a, b) + points_between(plant, a, b);
  }
}

void add_leaves(const Detail* rows, double* share, double* quads) {
  double most_share = 0, most_quads = 0;
  for (std::size_t row = glsl::kDetailSteps; row-- > 0;) {
    share[row] = most_share = std::max(most_share, static_cast<double>(rows[row].share));
    quads[row] = most_quads =
        std::max(most_quads, 1 - static_cast<double>(std::max(rows[row].to_points, rows[row].to_lines)));
  }
}

ListBounds::Plant measure(const PlantTable& table, const PlantHead& plant) {
  ListBounds::Plant bound{.cells = static_cast<double>(plant.cells)};
  for (std::uint32_t i = plant.first_cell; i < plant.first_cell + plant.cells; ++i) {
    const CellHead& cell = table.cells[i];
    bound.reach = std::max(bound.reach, glm::length(cell.centre - Vec3(0, 0, plant.middle)));
    bound.cell += (cell.radius + cell.sway) / static_cast<float>(plant.cells);
    bound.leaves += cell.count;
    bound.groups += groups(cell.count, glsl::kQuadGroup);
  }
  return bound;
}

}  // namespace

ListBounds make_list_bounds(const PlantTable& table) {
  ListBounds bounds;
  bounds.others.resize(table.details.size());
  bounds.share.resize(table.details.size());
  bounds.quads.resize(table.details.size());
  for (std::size_t i = 0; i < table.plants.size(); ++i) {
    const PlantHead& plant = table.plants[i];
    const std::size_t first = i * glsl::kDetailSteps;
    add_others(table, plant, &table.details[first], &bounds.others[first]);
    add_leaves(&table.details[first], &bounds.share[first], &bounds.quads[first]);
    bounds.plants.push_back(measure(table, plant));
  }
  return bounds;
}

ListSizes most_leaves(const ListBounds& bounds, std::size_t plant, std::size_t nearest, std::size_t row) {
  const ListBounds::Plant& p = bounds.plants[plant];
  const double quads = bounds.quads[plant * glsl::kDetailSteps + row];
  if (quads <= 0) return ListSizes(0);
  const double keep = bounds.share[plant * glsl::kDetailSteps + nearest] * quads * kMostShrinking * (1 + kSlack);
  // Of each cell one leaf more by chance, and a group that is not full: at most one group more.
  return {p.cells, std::min(p.groups, p.leaves * keep / glsl::kQuadGroup + p.cells), 0, 0};
}

}  // namespace manzana::foliage

#include "apps/walkthrough/survey.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "apps/walkthrough/plan_grid.h"

namespace manzana::walkthrough {
namespace {

constexpr double kCell = 150;        // metres, of the counts
constexpr double kWaterReach = 250;  // pieces of one water are nearer to each other than this
constexpr double kShortestRiver = 300;

struct Weighted {
  Vec2d plan{0, 0};
  double weight = 0;
};

Weighted middle(const Scene& scene, const LayerTable& t, std::uint32_t i) {
  const culling::Box box = t.boxes[i];
  const Vec2d min(box.min), max(box.max);
  return {Vec2d(scene.tree.origin) + (min + max) / 2.0, (max.x - min.x) * (max.y - min.y)};
}

std::vector<Weighted> building_volumes(const Scene& scene) {
  const LayerTable& t = scene.buildings.table;
  std::vector<Weighted> out;
  for (std::uint32_t i = 0; i < t.size(); ++i) {
    out.push_back(middle(scene, t, i));
    out.back().weight *= static_cast<double>(t.boxes[i].max.z - t.boxes[i].min.z);
  }
  return out;
}

std::vector<Weighted> tree_crowns(const Scene& scene) {
  std::vector<Weighted> out;
  for (std::uint32_t i = 0; i < scene.trees.table.size(); ++i) {
    out.push_back(middle(scene, scene.trees.table, i));
    out.back().weight = 1;
  }
  return out;
}

std::vector<Weighted> water_pieces(const Scene& scene) {
  const MeshLayer& layer = scene.surfaces;
  std::vector<Weighted> out;
  for (std::uint32_t i = 0; i < layer.table.size(); ++i) {
    if (layer.index_first[i] == layer.index_first[i + 1]) continue;
    const CityVertex& v = layer.mesh.vertices[layer.mesh.indices[layer.index_first[i]]];
    if (static_cast<Material>(v.colour >> 24) == Material::water) out.push_back(middle(scene, layer.table, i));
  }
  return out;
}

double quantile_of(std::vector<double> values, double p) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(p * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The middle of the heaviest 3 x 3 cells; `favour` scales a cell's weight.
template <class Favour>
std::optional<Weighted> heaviest(const std::vector<Weighted>& points, Favour favour) {
  std::map<std::pair<long, long>, Weighted> cells;  // plan: sum of weight * position
  for (const Weighted& p : points) {
    Weighted& cell = cells[{std::lround(p.plan.x / kCell), std::lround(p.plan.y / kCell)}];
    cell.plan += p.plan * p.weight;
    cell.weight += p.weight;
  }
  std::optional<Weighted> best;
  double best_score = 0;
  for (const auto& [at, unused] : cells) {
    Weighted sum;
    for (long dy = -1; dy <= 1; ++dy)
      for (long dx = -1; dx <= 1; ++dx)
        if (const auto cell = cells.find({at.first + dx, at.second + dy}); cell != cells.end()) {
          sum.plan += cell->second.plan;
          sum.weight += cell->second.weight;
        }
    const Vec2d where = sum.weight > 0 ? sum.plan / sum.weight : Vec2d(0, 0);
    const double score = sum.weight * favour(where);
    if (score > best_score) best_score = score, best = Weighted{where, sum.weight};
  }
  return best;
}

/// The pieces of the water with the largest area, pieces near each other being one water.
std::vector<Weighted> largest_water(const std::vector<Weighted>& pieces) {
  PlanGrid grid(kWaterReach);
  for (std::uint32_t i = 0; i < pieces.size(); ++i) grid.add(pieces[i].plan, pieces[i].plan, i);
  grid.finish();
  std::vector<char> seen(pieces.size());
  std::vector<Weighted> best;
  double best_area = 0;
  for (std::uint32_t start = 0; start < pieces.size(); ++start) {
    if (seen[start] != 0) continue;
    std::vector<Weighted> water;
    std::vector<std::uint32_t> todo{start};
    seen[start] = 1;
    double area = 0;
    while (!todo.empty()) {
      const Weighted piece = pieces[todo.back()];
      todo.pop_back();
      water.push_back(piece);
      area += piece.weight;
      grid.visit(piece.plan, kWaterReach, [&](std::uint32_t i) {
        if (seen[i] != 0 || glm::distance(pieces[i].plan, piece.plan) > kWaterReach) return;
        seen[i] = 1;
        todo.push_back(i);
      });
    }
    if (area > best_area) best_area = area, best = std::move(water);
  }
  return best;
}

/// The direction in which points spread most: the larger eigenvector of their covariance.
Vec2d main_axis(const std::vector<Weighted>& points, const Vec2d& mean) {
  double xx = 0, xy = 0, yy = 0;
  for (const Weighted& p : points) {
    const Vec2d d = p.plan - mean;
    xx += p.weight * d.x * d.x, xy += p.weight * d.x * d.y, yy += p.weight * d.y * d.y;
  }
  const double angle = std::atan2(2 * xy, xx - yy) / 2;
  return {std::cos(angle), std::sin(angle)};
}

/// Means of the pieces in cells along the main axis.
std::vector<Vec2d> center_line(const std::vector<Weighted>& water) {
  Weighted sum;
  for (const Weighted& p : water) sum.plan += p.plan * p.weight, sum.weight += p.weight;
  if (!(sum.weight > 0)) return {};
  const Vec2d mean = sum.plan / sum.weight, axis = main_axis(water, mean);
  std::map<long, Weighted> bins;
  for (const Weighted& p : water) {
    Weighted& bin = bins[std::lround(glm::dot(p.plan - mean, axis) / kCell)];
    bin.plan += p.plan * p.weight, bin.weight += p.weight;
  }
  std::vector<Vec2d> line;
  for (const auto& [unused, bin] : bins)
    if (bin.weight > 0) line.push_back(bin.plan / bin.weight);
  return line;
}

/// The part within the city: beyond it a river has nothing on its banks.
std::vector<Vec2d> find_river(const Scene& scene, const Survey& survey) {
  std::vector<Vec2d> line = center_line(largest_water(water_pieces(scene)));
  std::erase_if(line, [&](const Vec2d& p) { return glm::distance(p, survey.center) > survey.radius * 1.1; });
  if (line.size() < 3 || glm::distance(line.front(), line.back()) < kShortestRiver) line.clear();
  return line;
}

void measure_extent(const std::vector<Weighted>& points, double least, Survey& survey) {
  std::vector<double> x, y, distance;
  for (const Weighted& p : points) x.push_back(p.plan.x), y.push_back(p.plan.y);
  survey.center = {quantile_of(x, 0.5), quantile_of(y, 0.5)};
  for (const Weighted& p : points) distance.push_back(glm::distance(p.plan, survey.center));
  survey.radius = std::max(least, quantile_of(distance, 0.9));
}

}  // namespace

Survey survey_city(const Scene& scene) {
  const std::vector<Weighted> buildings = building_volumes(scene), trees = tree_crowns(scene);
  Survey survey;
  if (!buildings.empty() || !trees.empty())
    buildings.empty() ? measure_extent(trees, 5, survey) : measure_extent(buildings, 100, survey);
  else if (!scene.bounds.empty())
    survey.center = Vec2d(scene.bounds.min + scene.bounds.max) / 2.0;
  const auto near_center = [&](const Vec2d& p) {
    const double d = glm::distance(p, survey.center) / (survey.radius / 2);
    return 1 / (1 + d * d);
  };
  const auto heart = heaviest(buildings, near_center);
  survey.heart = heart ? heart->plan : survey.center;
  constexpr double kFewestTrees = 30;
  const auto wood = heaviest(trees, [](const Vec2d&) { return 1.0; });
  if (wood && wood->weight >= kFewestTrees) survey.wood = wood->plan;
  survey.river = find_river(scene, survey);
  return survey;
}

}  // namespace manzana::walkthrough

// Trees fill areas by dart throwing: every cell of a grid (one tree's share of ground a side) offers a few hashed
// places, round by round, and a place is taken when nothing stands within kGap cells of it. The places depend on the
// seed and the grid alone, and areas are taken in the order of their outlines, so the order of the file is without
// influence. [Cook 1986, dart throwing; numerics 12.3: a fixed number of tries, so it always ends]
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "scenegraph/import/meshes.h"
#include "scenegraph/import/plan_geometry.h"
#include "scenegraph/import/plan_index.h"
#include "scenegraph/import/tree_species.h"

namespace manzana {
namespace {

constexpr double kGap = 0.7;              // least distance of trees, in cells: 70 % of what random packing can hold
constexpr double kTries = 4.4;            // places a cell that give one tree a cell at kGap: measured, see the tests
constexpr double kMostPerHa = 4000;       // a nursery
constexpr double kMostTrees = 1'000'000;  // in all; beyond, every area is thinned alike
constexpr double kStreetMargin = 1.5;     // metres between a street's edge and a trunk
constexpr double kWallMargin = 1.5;
constexpr double kMappedMargin = 3;  // metres around trees that the map has already

std::uint64_t splitmix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9U;
  x = (x ^ x >> 27) * 0x94d049bb133111ebU;
  return x ^ x >> 31;
}
std::uint64_t place_hash(std::uint64_t seed, std::int64_t x, std::int64_t y, int round) {
  const std::uint64_t h = splitmix(seed ^ splitmix(static_cast<std::uint64_t>(x)));
  return splitmix(h ^
                  splitmix(static_cast<std::uint64_t>(y) + 0x632be59bd9b4e019U * static_cast<std::uint64_t>(round)));
}
double unit(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

/// Where no tree may stand.
struct Forbidden {
  plan::KeepClear lines;
  plan::PolygonSet grounds;

  explicit Forbidden(const CityFeatures& city) {
    for (const StreetFeature& s : city.streets) {
      if (s.tunnel) continue;
      if (s.circular) grounds.add({s.line, {}});
      for (std::size_t i = 1; i < s.line.size(); ++i) lines.add(s.line[i - 1], s.line[i], s.width / 2 + kStreetMargin);
    }
    for (const BuildingFeature& b : city.buildings) {
      grounds.add(b.footprint);
      outline(b.footprint.outer);
      for (const auto& hole : b.footprint.holes) outline(hole);
    }
    for (const AreaFeature& a : city.areas)
      if (a.kind == Material::water) grounds.add(a.shape);
  }
  void outline(const std::vector<Vec2d>& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) lines.add(ring[i], ring[(i + 1) % ring.size()], kWallMargin);
  }
  bool at(const Vec2d& p) const { return lines.hit(p) || grounds.contains(p); }
};

TreeFeature tree_at(const Vec2d& p, const AreaFeature& area, double cell, std::uint64_t hash) {
  constexpr double kTaller = 1.13, kNarrower = 0.9;  // than those that stand free
  const std::uint64_t a = splitmix(hash), b = splitmix(a), c = splitmix(b);
  TreeFeature tree{p, 0, 0, area.tree_kind};
  if (area.mixed) tree.kind = unit(a) < 0.5 ? PlantKind::broadleaf : PlantKind::conifer;
  tree.species = species_for(tree.kind, area.kind == Material::wood ? TreePlace::wood : TreePlace::park, splitmix(c));
  const TreeHabit h = habit_of(*tree.species);
  tree.height = h.low + (kTaller * h.high - h.low) * unit(b);
  const double crown = kNarrower * tree.height * h.crown * (0.85 + 0.3 * unit(c));
  tree.crown_radius = std::min(crown, 0.75 * cell);  // neighbours may mingle
  return tree;
}

struct Cell {
  std::int64_t x, y;
};

std::vector<Cell> cells_of(const plan::PolygonRows& rows, double size) {
  std::vector<Cell> cells;
  for (std::int64_t y = rows.row_low(); y <= rows.row_high(); ++y) {
    auto next = static_cast<std::int64_t>(std::floor(rows.low().x / size));
    for (const auto& span : rows.spans(y)) {
      const auto last = static_cast<std::int64_t>(std::floor(span.high / size));
      for (std::int64_t x = std::max(next, static_cast<std::int64_t>(std::floor(span.low / size))); x <= last; ++x)
        cells.push_back({x, y});
      next = std::max(next, last + 1);
    }
  }
  return cells;
}

class Forester {
 public:
  Forester(const CityFeatures& city, std::uint64_t seed, double least_gap)
      : forbidden_(city), taken_(std::max(least_gap, 2.0)), mapped_(kMappedMargin), seed_(seed) {
    for (const TreeFeature& t : city.trees)
      if (std::abs(t.position.x) < 1e7 && std::abs(t.position.y) < 1e7) mapped_.insert(t.position);
  }

  void plant(const AreaFeature& area, double per_ha) {
    const double cell = std::sqrt(1e4 / per_ha);
    const plan::PolygonRows rows(area.shape, cell);
    if (!rows.valid()) return;
    const std::vector<Cell> cells = cells_of(rows, cell);
    for (int round = 0; round < static_cast<int>(std::ceil(kTries)); ++round)
      for (const Cell& c : cells) offer(area, rows, cell, c, round);
  }
  std::vector<TreeFeature> take() { return std::move(trees_); }

 private:
  void offer(const AreaFeature& area, const plan::PolygonRows& rows, double cell, const Cell& c, int round) {
    const std::uint64_t hash = place_hash(seed_, c.x, c.y, round), more = splitmix(hash);
    if (unit(splitmix(more)) >= kTries - round) return;  // the last round is a part of one
    const Vec2d p = cell * Vec2d{static_cast<double>(c.x) + unit(hash), static_cast<double>(c.y) + unit(more)};
    if (taken_.any_within(p, kGap * cell) || !rows.contains(p)) return;
    if (mapped_.any_within(p, kMappedMargin) || forbidden_.at(p)) return;
    taken_.insert(p);
    trees_.push_back(tree_at(p, area, cell, hash));
  }

  Forbidden forbidden_;
  plan::PointGrid taken_, mapped_;
  std::uint64_t seed_;
  std::vector<TreeFeature> trees_;
};

bool before(const AreaFeature* a, const AreaFeature* b) {
  const auto key = [](const AreaFeature* f) {
    return std::tuple(f->shape.outer[0].x, f->shape.outer[0].y, f->shape.outer.size(), f->trees_per_ha, f->tree_kind,
                      f->mixed, f->where);
  };
  return key(a) < key(b);
}

bool plantable(const AreaFeature& a) {
  return a.trees_per_ha > 0 && std::isfinite(a.trees_per_ha) && a.shape.outer.size() >= 3 &&
         plan::finite(a.shape.outer) &&
         std::all_of(a.shape.holes.begin(), a.shape.holes.end(), [](const auto& hole) { return plan::finite(hole); });
}

}  // namespace

std::vector<TreeFeature> scatter_trees(const CityFeatures& features, std::uint64_t seed) {
  std::vector<const AreaFeature*> areas;
  double expected = 0, densest = 0;
  for (const AreaFeature& a : features.areas)
    if (plantable(a)) {
      areas.push_back(&a);
      const double per_ha = std::min(a.trees_per_ha, kMostPerHa);
      expected += per_ha * plan::area(a.shape) / 1e4;
      densest = std::max(densest, per_ha);
    }
  if (areas.empty()) return {};
  std::sort(areas.begin(), areas.end(), before);
  const double thinning = std::min(1.0, kMostTrees / std::max(expected, 1.0));
  Forester forester(features, seed, kGap * std::sqrt(1e4 / (densest * thinning)));
  for (const AreaFeature* a : areas) forester.plant(*a, std::min(a->trees_per_ha, kMostPerHa) * thinning);
  return forester.take();
}

}  // namespace manzana

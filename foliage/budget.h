#pragma once
/// What a frame may cost moves the error that is tolerated: as much is shown as the budget has room for, whatever is in
/// view. [Deussen 2005, section 10: a constant rate]
///   CostTable costs = make_costs(table);                                   // once a law
///   double error = error_for(costs, table, seen, {.vertices = 500'000});   // each frame: a pass over the trees in
///   view
#include <array>
#include <limits>
#include <vector>

#include "foliage/list_bounds.h"

namespace manzana::foliage {

/// What a tree takes: a row for each of a plant's details.
struct CostTable {
  std::vector<Vec2> vertices;  ///< of leaf quads, of all else: four a quad or line, one a point; as they are on average
  ListBounds lists;            ///< as they are at most

  /// Trees in view whose errors share a row: how many, and the sum of their squared errors. Of the frame at hand.
  struct Bin {
    double trees = 0, error2 = 0;
    double leaves = 0;                    ///< of how many trees the leaf quads are in view
    std::array<double, 5> by_nearness{};  ///< how many, by how much nearer than the tree its nearest cell is
  };
  std::vector<Bin> bins;
};
CostTable make_costs(const PlantTable& table);

struct Budget {
  double vertices = 0;     ///< of all trees in view; 0: no limit
  double most_error = 64;  ///< times the error that is asked for: beyond it so many vertices are too few
  ListSizes room{std::numeric_limits<double>::infinity()};  ///< of the lists; never exceeded
};

/// seen.error_at_1m, or as much more as the budget asks for; where both bind, the stricter. Infinite where not even the
/// greatest error makes room. Vertices are counted by trees' middles: cells nearer or farther average out. No
/// allocation.
double error_for(CostTable& costs, const PlantTable& table, const TreesSeen& seen, const Budget& budget);

}  // namespace manzana::foliage

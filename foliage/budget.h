#pragma once
/// What a frame may cost moves the error that is tolerated: as much is shown as the budget has room for, whatever is in
/// view. [Deussen 2005, section 10: a constant rate]
///   CostTable costs = make_costs(table, details);                      // once a law
///   double error = error_for(costs, table, seen, {.vertices = 500'000});   // each frame: a pass over the trees in
///   view
#include <vector>

#include "foliage/select.h"

namespace manzana::foliage {

/// Vertices that a tree takes: a row for each of a plant's details. Four a quad or line, one a point.
struct CostTable {
  std::vector<float> vertices;

  /// Trees in view whose errors share a row: how many, and the sum of their squared errors. Of the frame at hand.
  struct Bin {
    double trees = 0, error2 = 0;
  };
  std::vector<Bin> bins;
};
CostTable make_costs(const PlantTable& table);

struct Budget {
  double vertices = 0;     ///< of all trees in view; 0: no limit
  double most_error = 64;  ///< times the error that is asked for: beyond it the budget is broken
};

/// seen.error_at_1m, or as much more as the budget asks for. By trees' middles; cells nearer or farther than those
/// average out. No allocation.
double error_for(CostTable& costs, const PlantTable& table, const TreesSeen& seen, const Budget& budget);

}  // namespace manzana::foliage

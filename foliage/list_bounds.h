#pragma once
/// Never less than what extraction writes of a tree to its lists, so that sums over trees say whether those have room.
///   ListBounds bounds = make_list_bounds(table);                          // once a law
///   bounds.others[row] + most_leaves(bounds, plant, nearest_row, row)     // of a tree
#include <glm/vec4.hpp>
#include <vector>

#include "foliage/select.h"

namespace manzana::foliage {

/// Cells; groups of quads, of lines, of points.
using ListSizes = glm::dvec4;

struct ListBounds {
  /// A row for each of a plant's details.
  std::vector<ListSizes> others;  ///< all but leaves, of a tree with an error from the row's to the next
  std::vector<double> share;      ///< of a cell's leaf quads, with the row's error or a greater one
  std::vector<double> quads;      ///< the part of leaves that points do not replace, likewise
  struct Plant {
    float reach = 0;  ///< how far from the crown's middle a cell's may be, metres
    float cell = 0;   ///< mean radius of a cell, with its sway
    double cells = 0, leaves = 0, groups = 0;
  };
  std::vector<Plant> plants;
};
ListBounds make_list_bounds(const PlantTable& table);

/// Cells and leaf quads of a tree with an error of row `row` or more; none of its cells has less than `nearest`'s.
ListSizes most_leaves(const ListBounds& bounds, std::size_t plant, std::size_t nearest, std::size_t row);

}  // namespace manzana::foliage

#pragma once
/// How large, and how light, a few points must be to cover what a tree does and look like it. Points look the same from
/// everywhere, trees do not, and fewer points hide less of each other; so it is fitted, by drawing them, for each
/// number of points and from the sides, half way up and above.
///   add_grove(plant);                                      // by prepare(): some tenths of a second
///   double m2 = fitted(plant.grove.area, 0, 12);           // the sum of areas of 12 points, seen from the sides

#include "foliage/plant_table.h"

namespace manzana::foliage {

/// Puts the points that it draws in groves (foliage/grove_points.h) behind the plant's others, and their fit into it.
/// Of a plant of nothing: none.
void add_grove(PreparedPlant& plant);

/// Of a table of the fit, between the two next numbers of points; less than one: as many trees are missing as the
/// others stand for.
double fitted(const GroveFit::Table& table, std::size_t view, double points);

/// How much more a copy of the plant covers than one of natural size, of an ellipsoid's outline.
double outline_scale(const PreparedPlant& plant, const TreeSite& site, std::size_t view);

/// The first `n` of its points, at most kPlantPoints, for a tree of that hash: spread over the crown, and not the same
/// for each tree.
std::vector<std::uint32_t> chosen_points(const GroveFit& fit, std::uint32_t n, std::uint32_t hash);

}  // namespace manzana::foliage

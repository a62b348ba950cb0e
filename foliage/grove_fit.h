#pragma once
/// How large, and how light, a few points must be to cover what a tree does and look like it. Points look the same from
/// everywhere, trees do not, and fewer points hide less of each other; so it is fitted, by drawing them, for each
/// number of points and from the sides, 30 and 60 degrees over them and above.
///   add_grove(plant);                                      // by prepare(): some tenths of a second
///   double m2 = fitted(plant.grove.area, 0, 12);           // the sum of areas of 12 points, seen from the sides

#include <algorithm>
#include <cmath>

#include "foliage/plant_table.h"

namespace manzana::foliage {

/// Puts the points that it draws in groves (foliage/grove_points.h) behind the plant's others, and their fit into it.
/// Of a plant of nothing: none.
void add_grove(PreparedPlant& plant);

/// Between views that are known, 0: from the sides, kGroveViews - 1: from above.
template <class OfView>  // a number of (std::size_t view)
double between_views(double view, OfView&& of_view) {
  const auto i = std::min(static_cast<std::size_t>(view), kGroveViews - 2);
  return std::lerp(static_cast<double>(of_view(i)), static_cast<double>(of_view(i + 1)), view - static_cast<double>(i));
}

/// Of a table of the fit, between the two next numbers of points; less than one: as many trees are missing as the
/// others stand for.
double fitted(const GroveFit::Table& table, double view, double points);

/// From where parallel rays meet a plant of natural size as they meet a copy of it from `view`, and how much more the
/// copy covers then: rays are stretched with what they meet, so this is exact.
struct NaturalView {
  double view, scale;
};
NaturalView natural_view(const TreeSite& site, std::size_t view);

/// The first `n` of its points, at most kPlantPoints, for a tree of that hash: spread over the crown, and not the same
/// for each tree.
std::vector<std::uint32_t> chosen_points(const GroveFit& fit, std::uint32_t n, std::uint32_t hash);

}  // namespace manzana::foliage

#pragma once
/// How large, and how light, a few points must be to cover what a tree does and look like it. Points look the same from
/// everywhere, trees do not, and fewer points hide less of each other; so it is fitted, by drawing them, for each
/// number of points and from the sides, half way up and above.
///   GroveFit fit = fit_grove(plant);                       // some tenths of a second
///   double m2 = fitted(fit.area, 0, 12);                      // the sum of areas of 12 points, seen from the sides
#include <array>
#include <span>

#include "foliage/plant_table.h"

namespace manzana::foliage {

/// The sine of the eye's elevation is 0, 1/2, 1.
inline constexpr std::size_t kGroveViews = 3;
inline constexpr std::size_t kGroveFits = 8;  ///< 1, 2, 4, ... 128 points

struct GroveFit {
  Run points;                                 ///< the level of the plant's that they are of
  std::array<float, kGroveViews> cover_m2{};  ///< that the plant hides
  using Table = std::array<std::array<float, kGroveFits>, kGroveViews>;
  Table area{};   ///< m2
  Table light{};  ///< by what points must be lighter: few of them do not hide those within the crown, which are darker
};
/// `most`: points of a tree. Of a plant without points: nothing.
GroveFit fit_grove(const PreparedPlant& plant, std::uint32_t most);

/// Of a table of the fit, between the two next numbers of points; less than one: as many trees are missing as the
/// others stand for.
double fitted(const GroveFit::Table& table, std::size_t view, double points);

/// How much more a copy of the plant covers than one of natural size, of an ellipsoid's outline.
double outline_scale(const PreparedPlant& plant, const TreeSite& site, std::size_t view);

/// The first `n` of the level's points for a tree of that hash: spread over the crown, and not the same for each tree.
std::vector<std::uint32_t> chosen_points(const GroveFit& fit, std::uint32_t n, std::uint32_t hash);

}  // namespace manzana::foliage

#pragma once
/// What a city's data leaves unsaid, filled in by rule: the same for the same data, every run, on every machine.
/// Choices among several likely values are by a counter hash of the feature's id, so that neighbours differ and a
/// feature keeps its looks when others come or go.
///
/// Buildings [levels_of, roof_of, heights_of]
///   levels    by kind (kind = value of the tag `building`): 1 garage, shed, roof ...; 1 or 2 house; 2 farm, terrace,
///             school ...; 4 to 6 apartments, office, hotel ...; otherwise by footprint: under 40 m2 1, under 250 m2 1
///             to 3, under 3000 m2 the city's usual (the median of those that are told, if they are at least 20, else
///             3), plus or minus 1; halls beyond 2.
///   eaves     0.5 m + 3 m a level
///   roof      gabled (1 in 4 hipped) for small houses: footprint under 250 m2, at most 6 corners, at most 3 levels,
///             of a kind that people live in or of none; gabled for churches and farms; flat otherwise
///   its height  by the width w of the rectangle of like area and perimeter: gabled, hipped 0.45 w; pyramidal 0.6 w;
///             skillion 0.2 w; dome 0.5 w; within 1 to 6 m (pyramidal, dome: 12 m), and at most half the building
///   colours   walls from kWallPalette; flat roofs from kFlatRoofPalette, the others from kPitchedRoofPalette
/// Trees [tree_height, crown_radius]
///   by species: habit_of in tree_species.h; broadleaf 8 to 15 m, conifer 12 to 20 m, shrub 1.2 to 2.5 m; crown radius
///   0.27, 0.17, 0.5 of the height
/// Streets [lanes_of, width_of]
///   width = lanes * 3.1 m, where told; otherwise by class
#include <cstdint>
#include <string_view>

#include "scenegraph/import/features.h"

namespace manzana {

/// splitmix64 of (id, counter) [Steele, Lea, Flood, OOPSLA 2014]: uniform in [0, 1).
double chance(std::uint64_t id, std::uint64_t counter);

inline constexpr double kLevelHeight = 3.0, kGroundRise = 0.5;  // metres

struct BuildingSite {
  std::string_view kind;  ///< value of `building` or `building:part`; "yes" says nothing
  std::uint64_t id = 0;   ///< seed of its choices; parts of one building share it
  double area = 0;        ///< of the footprint, m2
  double perimeter = 0;   ///< of its outer ring, metres
  std::size_t corners = 4;
};

/// Storeys above ground, without the roof. usual_levels: of the city, see above.
int levels_of(const BuildingSite& site, int usual_levels);
RoofShape roof_of(const BuildingSite& site, double levels);
/// Metres, for a building whose top is `room` metres above its lowest floor (or infinity: not told).
double roof_height_of(const BuildingSite& site, RoofShape roof, double room);
std::uint32_t wall_colour_of(const BuildingSite& site);
std::uint32_t roof_colour_of(const BuildingSite& site, RoofShape roof);

double tree_height(PlantSpecies species, std::uint64_t id);
double crown_radius(PlantSpecies species, double height);

int lanes_of(StreetClass kind, bool one_way);
double width_of(StreetClass kind, bool one_way);
inline constexpr double kLaneWidth = 3.1;  // metres

}  // namespace manzana

#include "scenegraph/import/defaults.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "scenegraph/import/tree_species.h"

namespace manzana {
namespace {

// Counters of chance(): one for each question asked of an id.
enum Question : std::uint64_t { kLevels, kRoof, kWall, kRoofColour, kTreeHeight };

struct KindLevels {
  std::string_view kind;
  int least, most;
};
constexpr std::array<KindLevels, 48> kLevelsByKind{{
    {"apartments", 4, 6}, {"barn", 2, 2},           {"boathouse", 1, 1},
    {"bungalow", 1, 1},   {"cabin", 1, 1},          {"carport", 1, 1},
    {"cathedral", 5, 5},  {"chapel", 2, 2},         {"church", 4, 4},
    {"civic", 2, 4},      {"commercial", 3, 5},     {"construction", 2, 4},
    {"cowshed", 2, 2},    {"detached", 1, 2},       {"dormitory", 4, 5},
    {"farm", 2, 2},       {"farm_auxiliary", 2, 2}, {"garage", 1, 1},
    {"garages", 1, 1},    {"greenhouse", 1, 1},     {"hangar", 3, 3},
    {"hospital", 4, 6},   {"hotel", 4, 6},          {"house", 1, 2},
    {"hut", 1, 1},        {"industrial", 2, 3},     {"kindergarten", 1, 2},
    {"kiosk", 1, 1},      {"mosque", 3, 3},         {"office", 4, 6},
    {"parking", 3, 4},    {"public", 2, 4},         {"retail", 1, 2},
    {"roof", 1, 1},       {"school", 2, 3},         {"semidetached_house", 2, 2},
    {"service", 1, 1},    {"shed", 1, 1},           {"sports_hall", 3, 3},
    {"stable", 1, 1},     {"static_caravan", 1, 1}, {"supermarket", 2, 2},
    {"synagogue", 3, 3},  {"terrace", 2, 3},        {"train_station", 2, 3},
    {"university", 3, 5}, {"warehouse", 2, 3},      {"transformer_tower", 3, 3},
}};

// Plaster, brick and stone; sRGB.
constexpr std::array<std::uint32_t, 12> kWallPalette{0xe4dac6, 0xddd0b4, 0xd9c7a0, 0xe6e0d4, 0xcfc2ae, 0xd3b896,
                                                     0xc9ab8a, 0xb98f73, 0xa8735a, 0xc7bfb2, 0xd8d2c4, 0xbfb39d};
constexpr std::array<std::uint32_t, 5> kFlatRoofPalette{0x77736d, 0x86817a, 0x6a6763, 0x928c84, 0x7c7f80};
constexpr std::array<std::uint32_t, 6> kPitchedRoofPalette{0x9c5a3f, 0x8d4f3a, 0xa9674a, 0x7a4a3a, 0x5d5a5a, 0x6b5044};

std::uint32_t pick(std::span<const std::uint32_t> palette, std::uint64_t id, Question question) {
  return palette[static_cast<std::size_t>(chance(id, question) * static_cast<double>(palette.size()))];
}

int between(int least, int most, double u) { return least + static_cast<int>(u * (most - least + 1)); }

bool is_any(std::string_view kind, std::initializer_list<std::string_view> kinds) {
  return std::ranges::find(kinds, kind) != kinds.end();
}

/// The shorter side of the rectangle of like area and perimeter; of the square of like area where there is none.
double width_of_footprint(const BuildingSite& site) {
  const double half = site.perimeter / 4, rest = half * half - site.area;
  return rest > 0 ? site.area / (half + std::sqrt(rest)) : std::sqrt(site.area);
}

}  // namespace

double chance(std::uint64_t id, std::uint64_t counter) {
  std::uint64_t x = id + 0x9e3779b97f4a7c15u * (counter + 1);
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
  x = (x ^ x >> 27) * 0x94d049bb133111ebu;
  return static_cast<double>((x ^ x >> 31) >> 11) * 0x1p-53;
}

int levels_of(const BuildingSite& site, int usual_levels) {
  const double u = chance(site.id, kLevels);
  const auto row = std::ranges::find(kLevelsByKind, site.kind, &KindLevels::kind);
  if (row != kLevelsByKind.end()) return between(row->least, row->most, u);
  if (site.area < 40) return 1;
  if (site.area < 250) return between(1, 3, u);
  if (site.area < 3000) return std::max(1, usual_levels + between(-1, 1, u));
  return 2;
}

RoofShape roof_of(const BuildingSite& site, double levels) {
  if (is_any(site.kind, {"church", "chapel", "cathedral", "barn", "farm_auxiliary", "stable", "farm", "cowshed"}))
    return RoofShape::gabled;
  const bool dwelling = is_any(site.kind, {"yes", "house", "detached", "semidetached_house", "residential", "terrace",
                                           "bungalow", "cabin", "hut"});
  const bool small = site.area < 250 && site.area >= 30 && site.corners <= 6 && levels <= 3;
  if (!dwelling || !small) return RoofShape::flat;
  return chance(site.id, kRoof) < 0.25 ? RoofShape::hipped : RoofShape::gabled;
}

double roof_height_of(const BuildingSite& site, RoofShape roof, double room) {
  const double w = width_of_footprint(site);
  const auto limited = [&](double h, double most) { return std::min(std::clamp(h, 1.0, most), 0.5 * room); };
  switch (roof) {
    case RoofShape::flat:
      return 0;
    case RoofShape::gabled:
    case RoofShape::hipped:
      return limited(0.45 * w, 6);
    case RoofShape::pyramidal:
      return limited(0.6 * w, 12);
    case RoofShape::skillion:
      return limited(0.2 * w, 6);
    case RoofShape::dome:
      return limited(0.5 * w, 12);
  }
  return 0;
}

std::uint32_t wall_colour_of(const BuildingSite& site) { return pick(kWallPalette, site.id, kWall); }

std::uint32_t roof_colour_of(const BuildingSite& site, RoofShape roof) {
  if (roof == RoofShape::flat) return pick(kFlatRoofPalette, site.id, kRoofColour);
  return pick(kPitchedRoofPalette, site.id, kRoofColour);
}

double tree_height(PlantSpecies species, std::uint64_t id) {
  const TreeHabit habit = habit_of(species);
  return habit.low + (habit.high - habit.low) * chance(id, kTreeHeight);
}

double crown_radius(PlantSpecies species, double height) { return habit_of(species).crown * height; }

int lanes_of(StreetClass kind, bool one_way) {
  if (kind == StreetClass::motorway) return one_way ? 2 : 4;
  return one_way || kind >= StreetClass::service ? 1 : 2;
}

double width_of(StreetClass kind, bool one_way) {
  switch (kind) {
    case StreetClass::motorway:
      return one_way ? 7.5 : 15;
    case StreetClass::primary:
      return one_way ? 6.5 : 8;
    case StreetClass::secondary:
      return one_way ? 5.5 : 7;
    case StreetClass::residential:
      return one_way ? 4.5 : 6;
    case StreetClass::service:
      return 3.5;
    case StreetClass::pedestrian:
      return 5;
    case StreetClass::path:
      return 2;
    case StreetClass::track:
      return 2.8;
  }
  return 6;
}

}  // namespace manzana

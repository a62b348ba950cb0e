#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "scenegraph/import/defaults.h"
#include "scenegraph/import/osm_features.h"
#include "scenegraph/import/osm_parts.h"
#include "scenegraph/import/osm_tags.h"
#include "scenegraph/import/osm_values.h"

namespace manzana {
namespace {

constexpr ValueRange kHeights{0.1, 1000}, kFloors{0, 1000}, kLevels{0, 300};
constexpr int kFewTold = 20;     // told levels that make the city's usual
constexpr double kCanopy = 0.4;  // metres: thickness of a roof without walls

struct RoofName {
  std::string_view name;
  RoofShape shape;
};
// The named shapes of the OSM wiki (Key:roof:shape), each at the nearest of ours.
constexpr std::array<RoofName, 26> kRoofs{{
    {"flat", RoofShape::flat},
    {"gabled", RoofShape::gabled},
    {"hipped", RoofShape::hipped},
    {"pyramidal", RoofShape::pyramidal},
    {"skillion", RoofShape::skillion},
    {"dome", RoofShape::dome},
    {"half-hipped", RoofShape::hipped},
    {"half_hipped", RoofShape::hipped},
    {"side_hipped", RoofShape::hipped},
    {"side_half-hipped", RoofShape::hipped},
    {"hipped-and-gabled", RoofShape::hipped},
    {"mansard", RoofShape::hipped},
    {"gambrel", RoofShape::gabled},
    {"round", RoofShape::gabled},
    {"saltbox", RoofShape::gabled},
    {"double_saltbox", RoofShape::gabled},
    {"quadruple_saltbox", RoofShape::gabled},
    {"crosspitched", RoofShape::gabled},
    {"cross_gabled", RoofShape::gabled},
    {"gabled_height_moved", RoofShape::gabled},
    {"sawtooth", RoofShape::gabled},
    {"lean_to", RoofShape::skillion},
    {"onion", RoofShape::dome},
    {"cone", RoofShape::pyramidal},
    {"conical", RoofShape::pyramidal},
    {"spire", RoofShape::pyramidal},
}};

bool told(const osmium::TagList& tags, const char* key) {
  const char* value = tags[key];
  return value != nullptr && std::string_view(value) != "no";
}
bool is_outline(const osmium::TagList& tags) { return told(tags, "building"); }
bool underground(const osmium::TagList& tags) {
  const char* location = tags["location"];
  return location != nullptr && std::string_view(location) == "underground";
}
bool is_building(const osmium::TagList& tags) {
  return (is_outline(tags) || told(tags, "building:part")) && !underground(tags);
}

/// A footprint to be: one shape of an area.
struct Candidate {
  const OsmArea* area = nullptr;
  Polygon shape;
};
struct Candidates {
  std::vector<Candidate> outlines, parts;
};

Candidates split(const std::vector<OsmArea>& areas) {
  Candidates out;
  for (const OsmArea& area : areas) {
    auto& side = is_outline(*area.tags) ? out.outlines : out.parts;
    for (const Polygon& shape : area.shapes) side.push_back({&area, shape});
  }
  return out;
}

std::vector<Polygon> shapes_of(const std::vector<Candidate>& candidates) {
  std::vector<Polygon> out;
  for (const Candidate& candidate : candidates) out.push_back(candidate.shape);
  return out;
}

/// (relation?, id) of outlines that a relation of type building gives parts to, if any of those parts is there.
using OutlineIds = std::set<std::pair<bool, std::uint64_t>>;
OutlineIds outlines_with_parts(const OsmFile& osm, const std::vector<Candidate>& parts) {
  OutlineIds with_area, out;
  for (const Candidate& part : parts) with_area.emplace(part.area->relation, part.area->id);
  const auto key = [](const osmium::RelationMember& member) {
    return std::pair(member.type() == osmium::item_type::relation, static_cast<std::uint64_t>(member.ref()));
  };
  for (const osmium::Relation* relation : osm.relations) {
    const char* type = relation->tags()["type"];
    if (type == nullptr || std::string_view(type) != "building") continue;
    const auto& members = relation->members();
    if (std::none_of(members.begin(), members.end(), [&](const auto& m) { return with_area.contains(key(m)); }))
      continue;
    for (const osmium::RelationMember& member : members) {
      if (std::string_view(member.role()) == "outline") out.insert(key(member));
    }
  }
  return out;
}

BuildingSite site_of(const Candidate& candidate, const osmium::TagList& outline, std::uint64_t id) {
  BuildingSite site;
  const char* kind = outline["building"];
  if (kind == nullptr || std::string_view(kind) == "yes") kind = (*candidate.area->tags)["building:part"];
  site.kind = kind == nullptr ? "yes" : kind;
  site.id = id;
  site.area = area_of(candidate.shape);
  const auto& ring = candidate.shape.outer;
  for (std::size_t i = 0; i < ring.size(); ++i) site.perimeter += glm::length(ring[(i + 1) % ring.size()] - ring[i]);
  site.corners = ring.size();
  return site;
}

/// Attributes of one building; lives for it.
class Planner {
 public:
  Planner(const BuildingSite& site, const osmium::TagList& own, const osmium::TagList& outline, BuildingFeature& out,
          std::vector<Issue>& issues)
      : site_(site), tags_(own, out.where, issues), outline_tags_(outline), out_(out), issues_(issues) {}

  void run(int usual_levels) {
    const auto height = tags_.length("height", kHeights);
    const auto told_levels = tags_.number("building:levels", kLevels);
    const auto least_level = tags_.number("building:min_level", kLevels);
    const auto floor = tags_.length("min_height", kFloors);
    const double levels = told_levels ? *told_levels : levels_of(site_, usual_levels);
    out_.min_height = floor.value_or(least_level.value_or(0) * kLevelHeight);
    out_.roof = roof_shape(levels);
    if (height) {
      fit_under(*height);
    } else {
      stack(levels, told_levels.has_value());
    }
    if (site_.kind == "roof" || site_.kind == "carport") lift_canopy(floor.has_value());
    const double walls = out_.height - out_.roof_height - out_.min_height;
    out_.levels = told_levels ? storeys(*told_levels - least_level.value_or(out_.min_height / kLevelHeight), walls)
                              : storeys(walls / kLevelHeight, walls);
    paint();
  }

 private:
  RoofShape roof_shape(double levels) {
    const std::string_view name = tags_.text("roof:shape");
    if (name.empty()) return roof_of(site_, levels);
    const auto row = std::ranges::find(kRoofs, name, &RoofName::name);
    if (row != kRoofs.end()) return row->shape;
    tags_.complain("roof:shape", "is not a known shape");
    return roof_of(site_, levels);
  }

  /// room: metres from the lowest floor to the ridge; infinite where the height is not told.
  double roof_height(double room) {
    const auto height = tags_.length("roof:height", {0, 1000});
    const auto levels = tags_.number("roof:levels", {0, 20});
    if (out_.roof == RoofShape::flat) return 0;
    if (height) return std::min(*height, room);
    if (levels && *levels > 0) return std::min(*levels * kLevelHeight, 0.8 * room);
    return roof_height_of(site_, out_.roof, room);
  }

  void fit_under(double height) {
    if (out_.min_height > height - 0.1) {
      issues_.push_back({out_.where, "its lowest floor is not below its height: it stands on the ground"});
      out_.min_height = 0;
    }
    out_.height = height;
    out_.roof_height = roof_height(height - out_.min_height);
  }

  void stack(double levels, bool told_levels) {
    out_.roof_height = roof_height(std::numeric_limits<double>::infinity());
    if (levels == 0 && out_.roof_height == 0) levels = 1;
    double eaves = kGroundRise + levels * kLevelHeight;
    if (eaves < out_.min_height + 0.1) {
      if (told_levels) issues_.push_back({out_.where, "its lowest floor is not below its top: it gets one storey"});
      eaves = out_.min_height + kLevelHeight;
    }
    out_.height = eaves + out_.roof_height;
  }

  void lift_canopy(bool floor_told) {
    if (!floor_told) out_.min_height = std::max(out_.height - out_.roof_height - kCanopy, 0.0);
  }

  static int storeys(double levels, double walls) {
    const double room = std::max(walls / 2.0, 1.0);  // windows need two metres
    return static_cast<int>(std::clamp(std::round(levels), 1.0, room));
  }

  void paint() {
    TagReader outline(outline_tags_, out_.where, issues_);
    out_.wall_rgb = colour(outline, "building:colour", "building:material").value_or(wall_colour_of(site_));
    const auto roof = colour(outline, "roof:colour", "roof:material");
    out_.roof_rgb = roof.value_or(roof_colour_of(site_, out_.roof));
  }

  /// Its own colour or material, else that of its outline.
  std::optional<std::uint32_t> colour(TagReader& outline, const char* colour_key, const char* material_key) {
    if (const auto own = tags_.colour(colour_key)) return own;
    if (const auto own = material_colour(tags_.text(material_key))) return own;
    if (const auto theirs = parse_colour(outline.text(colour_key))) return theirs;
    return material_colour(outline.text(material_key));
  }

  const BuildingSite& site_;
  TagReader tags_;
  const osmium::TagList& outline_tags_;
  BuildingFeature& out_;
  std::vector<Issue>& issues_;
};

/// Median of the levels that are told of buildings that are no huts.
int usual_levels(const std::vector<Candidate>& outlines) {
  std::vector<double> levels;
  for (const Candidate& outline : outlines) {
    const char* text = (*outline.area->tags)["building:levels"];
    const auto value = text == nullptr ? std::nullopt : parse_number(text);
    if (value && *value >= 1 && *value <= kLevels.most && area_of(outline.shape) >= 150) levels.push_back(*value);
  }
  if (levels.size() < kFewTold) return 3;
  std::ranges::nth_element(levels, levels.begin() + static_cast<std::ptrdiff_t>(levels.size() / 2));
  return std::clamp(static_cast<int>(std::lround(levels[levels.size() / 2])), 2, 8);
}

void append(const Candidate& candidate, const OsmArea& outline, int usual, CityFeatures& city) {
  BuildingFeature building;
  building.where = candidate.area->where;
  building.footprint = candidate.shape;
  building.attributes = row_of(*candidate.area->tags, candidate.area->source(), city.attributes, outline.tags);
  Planner(site_of(candidate, *outline.tags, outline.id), *candidate.area->tags, *outline.tags, building, city.issues)
      .run(usual);
  city.buildings.push_back(std::move(building));
}

/// Where parts hang in the air over most of an outline, because only the upper floors were mapped as parts, the outline
/// itself stands below them.
void append_bases(const Candidates& found, const PartCover& cover, const std::vector<bool>& by_parts,
                  std::size_t first_part, int usual, CityFeatures& city) {
  std::vector<double> lowest(found.outlines.size(), std::numeric_limits<double>::infinity());
  std::vector<Polygon> grounded;
  for (std::size_t i = 0; i < found.parts.size(); ++i) {
    const double floor = city.buildings[first_part + i].min_height;
    if (floor < kLevelHeight / 2)
      grounded.push_back(found.parts[i].shape);
    else if (cover.outline_of[i] != kNoOutline)
      lowest[cover.outline_of[i]] = std::min(lowest[cover.outline_of[i]], floor);
  }
  const PartCover standing = cover_by_parts(shapes_of(found.outlines), grounded);
  for (std::size_t i = 0; i < found.outlines.size(); ++i) {
    if (!by_parts[i] || !std::isfinite(lowest[i]) || standing.covered[i] > 0.5) continue;
    append(found.outlines[i], *found.outlines[i].area, usual, city);
    BuildingFeature& base = city.buildings.back();
    if (base.min_height > 0) {
      city.buildings.pop_back();  // a bridge between houses: it is meant to hang
      continue;
    }
    base.height = lowest[i];
    base.roof = RoofShape::flat;
    base.roof_height = 0;
    base.levels = std::max(1, static_cast<int>(std::lround(lowest[i] / kLevelHeight)));
  }
}

}  // namespace

void read_buildings(const OsmFile& osm, const OsmShapes& shapes, CityFeatures& city) {
  const std::vector<OsmArea> areas = shapes.areas(is_building, city.issues);
  const Candidates found = split(areas);
  const PartCover cover = cover_by_parts(shapes_of(found.outlines), shapes_of(found.parts));
  const OutlineIds replaced = outlines_with_parts(osm, found.parts);
  const int usual = usual_levels(found.outlines);
  std::vector<bool> by_parts(found.outlines.size());
  for (std::size_t i = 0; i < found.outlines.size(); ++i) {
    const OsmArea& area = *found.outlines[i].area;
    by_parts[i] = cover.covered[i] > 0.5 || replaced.contains({area.relation, area.id});
    if (!by_parts[i]) append(found.outlines[i], area, usual, city);
  }
  const std::size_t first_part = city.buildings.size();
  for (std::size_t i = 0; i < found.parts.size(); ++i) {
    const std::uint32_t outline = cover.outline_of[i];
    append(found.parts[i], outline == kNoOutline ? *found.parts[i].area : *found.outlines[outline].area, usual, city);
  }
  append_bases(found, cover, by_parts, first_part, usual, city);
}

}  // namespace manzana

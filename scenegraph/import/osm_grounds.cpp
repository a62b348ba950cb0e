#include <algorithm>
#include <array>
#include <cmath>

#include "scenegraph/import/geos.h"
#include "scenegraph/import/osm_features.h"
#include "scenegraph/import/osm_tags.h"
#include "scenegraph/import/osm_values.h"

namespace manzana {
namespace {

/// What an area with this tag looks like; trees a hectare where its own tags say nothing.
struct GroundRule {
  std::string_view key, value;
  Material kind;
  double trees_per_ha;
  PlantKind tree;
  bool mixed;
};
using enum Material;
constexpr PlantKind kLeafy = PlantKind::broadleaf;
// The first rule that fits counts.
constexpr std::array<GroundRule, 44> kRules{{
    {"natural", "water", water, 0, kLeafy, false},
    {"waterway", "riverbank", water, 0, kLeafy, false},
    {"waterway", "dock", water, 0, kLeafy, false},
    {"landuse", "reservoir", water, 0, kLeafy, false},
    {"landuse", "basin", water, 0, kLeafy, false},
    {"leisure", "swimming_pool", water, 0, kLeafy, false},
    {"natural", "wood", wood, 220, kLeafy, true},
    {"landuse", "forest", wood, 220, kLeafy, true},
    {"landuse", "orchard", grass, 120, kLeafy, false},
    {"natural", "scrub", wood, 150, PlantKind::shrub, false},
    {"natural", "heath", grass, 40, PlantKind::shrub, false},
    {"natural", "grassland", grass, 2, kLeafy, false},
    {"natural", "beach", sand, 0, kLeafy, false},
    {"natural", "sand", sand, 0, kLeafy, false},
    {"natural", "shingle", sand, 0, kLeafy, false},
    {"leisure", "park", park, 25, kLeafy, true},
    {"leisure", "garden", park, 15, kLeafy, false},
    {"leisure", "nature_reserve", grass, 0, kLeafy, false},
    {"leisure", "pitch", grass, 0, kLeafy, false},
    {"leisure", "golf_course", grass, 8, kLeafy, true},
    {"leisure", "common", grass, 4, kLeafy, false},
    {"leisure", "dog_park", grass, 6, kLeafy, false},
    {"leisure", "playground", sand, 0, kLeafy, false},
    {"landuse", "grass", grass, 0, kLeafy, false},
    {"landuse", "meadow", grass, 2, kLeafy, false},
    {"landuse", "village_green", grass, 8, kLeafy, false},
    {"landuse", "recreation_ground", grass, 6, kLeafy, false},
    {"landuse", "cemetery", park, 30, kLeafy, true},
    {"amenity", "grave_yard", park, 30, kLeafy, true},
    {"landuse", "allotments", park, 12, PlantKind::shrub, false},
    {"landuse", "greenfield", grass, 1, kLeafy, false},
    {"landuse", "flowerbed", park, 0, kLeafy, false},
    {"landuse", "plant_nursery", farmland, 60, PlantKind::shrub, false},
    {"landuse", "farmland", farmland, 0, kLeafy, false},
    {"landuse", "farm", farmland, 0, kLeafy, false},
    {"landuse", "vineyard", farmland, 200, PlantKind::shrub, false},
    {"amenity", "parking", pavement, 0, kLeafy, false},
    {"place", "square", pavement, 0, kLeafy, false},
    {"highway", "pedestrian", pavement, 0, kLeafy, false},
    {"highway", "footway", pavement, 0, kLeafy, false},
    {"highway", "path", pavement, 0, kLeafy, false},
    {"highway", "service", asphalt, 0, kLeafy, false},
    {"highway", "residential", asphalt, 0, kLeafy, false},
    {"man_made", "pier", pavement, 0, kLeafy, false},
}};

bool below_ground(const osmium::TagList& tags) {
  const char* parking = tags["parking"];
  const char* location = tags["location"];
  return says_yes(tags["tunnel"]) || says_yes(tags["indoor"]) ||
         (location != nullptr && std::string_view(location) == "underground") ||
         (parking != nullptr && std::string_view(parking) != "surface");
}

const GroundRule* rule_for(const osmium::TagList& tags) {
  const auto fits = [&](const GroundRule& rule) {
    const char* value = tags[rule.key.data()];  // the keys are literals
    return value != nullptr && value == rule.value;
  };
  const auto rule = std::ranges::find_if(kRules, fits);
  if (rule == kRules.end() || below_ground(tags)) return nullptr;
  // A closed street is a line unless it says that it is an area; a building stands on its ground by itself.
  const bool needs_area = rule->key == "highway" || rule->key == "man_made";
  const char* type = tags["type"];
  const bool area = says_yes(tags["area"]) || (type != nullptr && std::string_view(type) == "multipolygon");
  return (needs_area && !area) || tags.has_key("building") ? nullptr : &*rule;
}

void take_leaf_type(const osmium::TagList& tags, AreaFeature& area) {
  const char* leaves = tags["leaf_type"];
  if (leaves == nullptr) leaves = tags["wood"];  // the older key
  if (leaves == nullptr || area.trees_per_ha == 0) return;
  const std::string_view type = leaves;
  if (type == "broadleaved" || type == "deciduous") area.mixed = false;
  if (type == "mixed") area.mixed = true;
  if (type == "needleleaved" || type == "coniferous") {
    area.tree_kind = PlantKind::conifer;
    area.mixed = false;
  }
}

void append_areas(const OsmArea& area, CityFeatures& city) {
  const GroundRule& rule = *rule_for(*area.tags);
  const std::uint32_t attributes = row_of(*area.tags, area.source(), city.attributes);
  for (const Polygon& shape : area.shapes) {
    AreaFeature feature{area.where, shape, rule.kind, rule.trees_per_ha, rule.tree, rule.mixed};
    take_leaf_type(*area.tags, feature);
    feature.attributes = attributes;
    city.areas.push_back(std::move(feature));
  }
}

/// Metres; none for what is too small to draw or runs under the ground.
std::optional<double> stream_width(TagReader& tags) {
  const std::string_view kind = tags.text("waterway");
  const double usual = kind == "river" ? 12 : kind == "canal" ? 8 : kind == "stream" ? 2.5 : 0;
  if (usual == 0 || tags.yes("tunnel") || tags.yes("covered")) return std::nullopt;
  return tags.length("width", {0.3, 2000}).value_or(usual);
}

void append_stream(const Geos& geos, const osmium::Way& way, const OsmShapes& shapes, CityFeatures& city) {
  const std::string where = where_of(way);
  TagReader tags(way.tags(), where, city.issues);
  const auto width = stream_width(tags);
  if (!width) return;
  const OsmLine line = shapes.line(way.nodes());
  if (line.missing > 0) city.issues.push_back({where, std::to_string(line.missing) + " nodes are not in the file"});
  const Geometry middle = line.points.size() > 1 ? geos.line(line.points) : geos.owned(nullptr);
  const Geometry bed = geos.owned(middle ? GEOSBufferWithStyle_r(geos.handle(), middle.get(), *width / 2, 3,
                                                                 GEOSBUF_CAP_ROUND, GEOSBUF_JOIN_ROUND, 5)
                                         : nullptr);
  const std::vector<Polygon> beds = bed ? geos.polygons(bed.get()) : std::vector<Polygon>();
  if (beds.empty()) city.issues.push_back({where, "no line to widen"});
  const std::uint32_t attributes = row_of(way.tags(), source_of(way), city.attributes);
  for (const Polygon& shape : beds) city.areas.push_back({where, shape, water, 0, kLeafy, false, attributes});
}

/// By density alone; square metres to hectares: 1e-4.
double trees_of(const AreaFeature& area) { return area.trees_per_ha * area_of(area.shape) * 1e-4; }

/// The number that each may hold at most, so that all together hold `most`: small ones keep all of theirs.
double fair_share(std::vector<double> numbers, double most) {
  std::ranges::sort(numbers);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double share = most / static_cast<double>(numbers.size() - i);
    if (numbers[i] > share) return share;
    most -= numbers[i];
  }
  return numbers.empty() ? 0 : numbers.back();
}

/// Only the largest woods are thinned: groves and parks, which one walks through, stay as they are.
void limit_trees(CityFeatures& city) {
  std::vector<double> numbers;
  double all = 0;
  for (const AreaFeature& area : city.areas) all += numbers.emplace_back(trees_of(area));
  if (all <= kMostScattered) return;
  const double share = fair_share(numbers, kMostScattered);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (numbers[i] > share) city.areas[i].trees_per_ha *= share / numbers[i];
  city.issues.push_back({"woods and greens", "would hold " + std::to_string(std::llround(all)) +
                                                 " trees: those with over " + std::to_string(std::llround(share)) +
                                                 " thinned to that"});
}

}  // namespace

void read_grounds(const OsmFile& osm, const OsmShapes& shapes, CityFeatures& city) {
  const auto wanted = [](const osmium::TagList& tags) { return rule_for(tags) != nullptr; };
  for (const OsmArea& area : shapes.areas(wanted, city.issues)) append_areas(area, city);
  const Geos geos;
  for (const osmium::Way* way : osm.ways) {
    if (way->tags().has_key("waterway") && !rule_for(way->tags())) append_stream(geos, *way, shapes, city);
  }
  limit_trees(city);
}

}  // namespace manzana

#include <algorithm>
#include <array>
#include <cmath>

#include "scenegraph/import/defaults.h"
#include "scenegraph/import/osm_features.h"
#include "scenegraph/import/osm_tags.h"

namespace manzana {
namespace {

struct ClassName {
  std::string_view highway;
  StreetClass kind;
};
constexpr std::array<ClassName, 23> kClasses{{
    {"motorway", StreetClass::motorway},
    {"motorway_link", StreetClass::motorway},
    {"trunk", StreetClass::motorway},
    {"trunk_link", StreetClass::motorway},
    {"primary", StreetClass::primary},
    {"primary_link", StreetClass::primary},
    {"secondary", StreetClass::secondary},
    {"secondary_link", StreetClass::secondary},
    {"tertiary", StreetClass::secondary},
    {"tertiary_link", StreetClass::secondary},
    {"unclassified", StreetClass::residential},
    {"residential", StreetClass::residential},
    {"living_street", StreetClass::residential},
    {"road", StreetClass::residential},
    {"service", StreetClass::service},
    {"busway", StreetClass::service},
    {"pedestrian", StreetClass::pedestrian},
    {"footway", StreetClass::path},
    {"path", StreetClass::path},
    {"cycleway", StreetClass::path},
    {"steps", StreetClass::path},
    {"bridleway", StreetClass::path},
    {"track", StreetClass::track},
}};

std::optional<StreetClass> class_of(std::string_view highway) {
  const auto row = std::ranges::find(kClasses, highway, &ClassName::highway);
  return row == kClasses.end() ? std::nullopt : std::optional(row->kind);
}

/// Inside buildings: not a street of the city.
bool indoors(const TagReader& tags) {
  if (tags.yes("indoor") || tags.is("highway", "corridor")) return true;
  const std::string_view level = tags.text("level");
  return !level.empty() && level != "0" && !tags.yes("bridge");
}

/// 1 along the way, -1 against it, 0 both.
int direction_of(const TagReader& tags, StreetClass kind) {
  const std::string_view one_way = tags.text("oneway");
  if (one_way == "-1" || one_way == "reverse") return -1;
  if (one_way == "yes" || one_way == "true" || one_way == "1") return 1;
  const bool by_kind = tags.is("junction", "roundabout") || tags.is("junction", "circular") ||
                       tags.is("highway", "motorway") || tags.is("highway", "motorway_link");
  return by_kind && one_way != "no" && kind <= StreetClass::service ? 1 : 0;
}

StreetFeature attributes_of(TagReader& tags, StreetClass kind) {
  StreetFeature street;
  street.kind = kind;
  street.one_way = direction_of(tags, kind) != 0;
  const auto lanes = tags.number("lanes", {1, 16});
  street.lanes = lanes ? static_cast<int>(std::lround(*lanes)) : lanes_of(kind, street.one_way);
  const double usual = lanes && carries_traffic(kind) ? street.lanes * kLaneWidth : width_of(kind, street.one_way);
  street.width = tags.length("width", {0.3, 80}).value_or(usual);
  street.bridge = tags.yes("bridge");
  street.tunnel = tags.yes("tunnel");
  const auto layer = tags.number("layer", {-10, 10});
  street.layer = layer ? static_cast<int>(std::lround(*layer)) : (street.bridge ? 1 : 0) - (street.tunnel ? 1 : 0);
  return street;
}

void read_street(const osmium::Way& way, const OsmShapes& shapes, CityFeatures& city, int& left) {
  const std::string where = where_of(way);
  TagReader tags(way.tags(), where, city.issues);
  const auto kind = class_of(tags.text("highway"));
  if (!kind || tags.yes("area") || indoors(tags)) return;
  OsmLine line = shapes.line(way.nodes());
  if (line.points.size() < 2) {
    city.issues.push_back({where, "fewer than two nodes are in the file"});
    return;
  }
  if (line.missing > 0) city.issues.push_back({where, std::to_string(line.missing) + " nodes are not in the file"});
  StreetFeature street = attributes_of(tags, *kind);
  street.where = where;
  street.attributes = row_of(way.tags(), source_of(way), city.attributes);
  street.line = std::move(line.points);
  street.nodes = std::move(line.nodes);
  if (direction_of(tags, *kind) < 0) {
    std::ranges::reverse(street.line);
    std::ranges::reverse(street.nodes);
  }
  left += tags.is("driving_side", "left") ? 1 : tags.is("driving_side", "right") ? -1 : 0;
  city.streets.push_back(std::move(street));
}

}  // namespace

void read_streets(const OsmFile& osm, const OsmShapes& shapes, CityFeatures& city) {
  int left = 0;
  for (const osmium::Way* way : osm.ways) {
    if (way->tags().has_key("highway")) read_street(*way, shapes, city, left);
  }
  city.left_hand_traffic = left > 0;
}

}  // namespace manzana

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scenegraph/import/defaults.h"
#include "scenegraph/import/osm_features.h"
#include "scenegraph/import/osm_tags.h"
#include "scenegraph/import/tree_species.h"

namespace manzana {
namespace {

/// Metres, from the girth of the trunk: about 60 trunk diameters for a slim tree, levelling off at 30 m.
std::optional<double> height_by_girth(TagReader& tags) {
  auto girth = tags.length("circumference", {0.01, 2000});
  if (!girth) return std::nullopt;
  if (*girth > 20) *girth /= 100;  // no trunk has 20 m: centimetres, as many type them
  return 2 + 28 * (1 - std::exp(-60 * *girth / std::numbers::pi / 28));
}

PlantSpecies species_of(const osmium::TagList& tags, PlantKind kind, TreePlace place, std::uint64_t identity) {
  for (const char* key : {"genus", "species", "taxon"}) {
    const std::string genus = tags[key] == nullptr ? "" : genus_in(tags[key]);
    if (genus.empty()) continue;
    const PlantSpecies species = species_of_genus(genus).value_or(plain_species(kind));
    return kind_of(species) == kind ? species : plain_species(kind);
  }
  return species_for(kind, place, identity);
}

TreeFeature tree_of(TagReader& tags, const osmium::TagList& list, std::uint64_t id, Vec2d position, TreePlace place,
                    std::uint64_t identity) {
  TreeFeature tree;
  tree.position = position;
  tree.kind = plant_kind(list);
  const PlantSpecies species = species_of(list, tree.kind, place, identity);
  tree.species = species;
  const auto by_girth = height_by_girth(tags);
  const auto height = tags.length("height", {0.3, 120});
  tree.height = height ? *height : by_girth.value_or(tree_height(species, id));
  const auto crown = tags.length("diameter_crown", {0.2, 60});
  tree.crown_radius = crown ? *crown / 2 : crown_radius(species, tree.height);
  return tree;
}

void read_tree_row(const osmium::Way& way, const OsmShapes& shapes, CityFeatures& city) {
  const std::string where = where_of(way);
  TagReader tags(way.tags(), where, city.issues);
  const OsmLine line = shapes.line(way.nodes());
  if (line.points.size() < 2) {
    city.issues.push_back({where, "fewer than two nodes are in the file"});
    return;
  }
  const auto row = static_cast<std::uint64_t>(way.id());
  const std::uint32_t attributes = row_of(way.tags(), source_of(way), city.attributes);
  std::uint64_t index = 0;
  double next = kTreeRowStep / 2, start = 0;
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    const Vec2d a = line.points[i - 1], b = line.points[i];
    const double length = glm::length(b - a);
    for (; next <= start + length && length > 0; next += kTreeRowStep) {
      const std::uint64_t id = static_cast<std::uint64_t>(way.id()) * 1000003u + index++;
      TreeFeature tree = tree_of(tags, way.tags(), id, a + (b - a) * ((next - start) / length), TreePlace::row, row);
      tree.attributes = attributes;
      city.trees.push_back(tree);
    }
    start += length;
  }
}

}  // namespace

PlantKind plant_kind(const osmium::TagList& tags) {
  const auto is = [&](const char* key, std::string_view value) {
    const char* found = tags[key];
    return found != nullptr && found == value;
  };
  if (is("natural", "shrub")) return PlantKind::shrub;
  if (is("leaf_type", "needleleaved")) return PlantKind::conifer;
  for (const char* key : {"genus", "species", "taxon"}) {
    if (const auto kind = kind_of_name(tags[key] == nullptr ? "" : tags[key])) return *kind;
  }
  if (tags.has_key("leaf_type")) return PlantKind::broadleaf;
  return is("leaf_cycle", "evergreen") ? PlantKind::conifer : PlantKind::broadleaf;
}

void read_trees(const OsmFile& osm, const OsmShapes& shapes, CityFeatures& city) {
  for (const osmium::Node* node : osm.plants) {
    const auto position = shapes.position(node->id());
    const std::string where = where_of(*node);
    TagReader tags(node->tags(), where, city.issues);
    if (position) {
      const auto id = static_cast<std::uint64_t>(node->id());
      city.trees.push_back(tree_of(tags, node->tags(), id, *position, TreePlace::park, id));
      city.trees.back().attributes = row_of(node->tags(), source_of(*node), city.attributes);
    } else {
      city.issues.push_back({where, "too far from the rest of the data"});
    }
  }
  for (const osmium::Way* way : osm.ways) {
    const char* natural = way->tags()["natural"];
    if (natural != nullptr && std::string_view(natural) == "tree_row") read_tree_row(*way, shapes, city);
  }
}

}  // namespace manzana

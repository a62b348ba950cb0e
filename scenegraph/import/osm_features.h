#pragma once
/// From an OpenStreetMap file to features, a function for each kind. Each appends to `city` and lists its issues there.
#include "scenegraph/import/osm_file.h"
#include "scenegraph/import/osm_shapes.h"

namespace manzana {

/// building and building:part, ways and multipolygons. An outline that its parts cover for more than half, or that a
/// relation of type building says has parts, is left out: its parts are drawn.  [OSM wiki: Simple 3D Buildings]
void read_buildings(const OsmFile& osm, const OsmShapes& shapes, CityFeatures& city);

/// highway lines; squares and other paved areas are grounds.
void read_streets(const OsmFile& osm, const OsmShapes& shapes, CityFeatures& city);

/// natural=tree and natural=shrub, and tree_row: one every kTreeRowStep.
void read_trees(const OsmFile& osm, const OsmShapes& shapes, CityFeatures& city);
inline constexpr double kTreeRowStep = 8;  // metres

/// Greens, woods, water (areas, and lines made as wide as they are), sand, farmland, paved squares. Densities of trees
/// are lowered, in the largest first, where they would give more than kMostScattered trees in all.
void read_grounds(const OsmFile& osm, const OsmShapes& shapes, CityFeatures& city);
inline constexpr double kMostScattered = 90000;

/// From leaf_type, genus, species, taxon, leaf_cycle; broadleaf where they say nothing.
PlantKind plant_kind(const osmium::TagList& tags);

}  // namespace manzana

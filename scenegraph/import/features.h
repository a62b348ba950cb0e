#pragma once
/// What a city is before it becomes a scene: features with a shape in plan and a few attributes, every attribute filled
/// in. Readers (OpenStreetMap, CityJSON, lists of trees, the built-in town) make these; build_scene makes a scene of
/// them.
/// Plan positions are (x, y) in the frame L, metres. Rings are open (the last point is not the first again), in either
/// direction. Nothing here is trusted: rings may cross themselves, streets may have one point.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenegraph/attributes.h"
#include "scenegraph/local_frame.h"
#include "scenegraph/scene.h"

namespace manzana {

/// A feature that was left out or mended, and why: {"way 4711 (building)", "ring is not closed"}.
struct Issue {
  std::string where, what;
};

struct Polygon {
  std::vector<Vec2d> outer;
  std::vector<std::vector<Vec2d>> holes;
};

enum class RoofShape : std::uint8_t { flat, gabled, hipped, pyramidal, skillion, dome };

struct BuildingFeature {
  std::string where;  ///< for issues: "way 4711"
  Polygon footprint;
  double height = 6;       ///< of the ridge above ground, metres; > min_height
  double min_height = 0;   ///< of the lowest floor above ground
  double roof_height = 0;  ///< of the roof alone; <= height - min_height
  int levels = 2;          ///< storeys between min_height and the eaves, at least 1
  RoofShape roof = RoofShape::flat;
  std::uint32_t wall_rgb = 0xd8cfc0, roof_rgb = 0x8a8580;  ///< sRGB, 0xRRGGBB
  std::uint32_t attributes = 0;                            ///< row of CityFeatures::attributes
};

/// A building or other work that brings surfaces of its own: plane polygons in space, with holes. Points are (x, y in
/// plan, height above ground). Flat: a face is a run of rings, a ring a run of corners, a part a run of faces (one
/// solid or one set of surfaces). Outer rings come first and are counter-clockwise seen from outside, so it is hoped.
struct ConstructionFeature {
  struct Face {
    std::uint32_t last_ring = 0;  ///< begins where the face before it ends
    std::uint32_t rgb = 0xb4b2ab;
    Material kind = Material::concrete;  ///< wall, roof or concrete
    std::uint32_t texture = 0;           ///< of CityFeatures::pictures, from 1; 0: none
  };
  std::string where;
  std::vector<Vec3d> points;
  std::vector<std::uint32_t> corners;    ///< of points
  std::vector<std::uint32_t> ring_last;  ///< of corners; a ring begins where the one before it ends
  std::vector<Face> faces;
  std::vector<std::uint32_t> part_last;  ///< of faces; likewise
  std::vector<Vec2> uv;                  ///< a row a corner: right and up on the face's picture; empty: no face has one
  std::uint32_t attributes = 0;          ///< row of CityFeatures::attributes
};

enum class StreetClass : std::uint8_t { motorway, primary, secondary, residential, service, pedestrian, path, track };

struct StreetFeature {
  std::string where;
  std::vector<Vec2d> line;          ///< in driving order for one-way streets
  std::vector<std::int64_t> nodes;  ///< an id a point: streets meet where ids are equal
  double width = 6;                 ///< of the carriageway, metres
  int lanes = 2;                    ///< in all
  int layer = 0;
  StreetClass kind = StreetClass::residential;
  bool one_way = false, bridge = false, tunnel = false,
       circular = false;         ///< circular: a closed area, such as a square
  std::uint32_t attributes = 0;  ///< row of CityFeatures::attributes
};
/// Cars drive there, and it bounds blocks: motorway to residential.
inline bool carries_traffic(StreetClass kind) { return kind <= StreetClass::residential; }

struct TreeFeature {
  Vec2d position{0, 0};
  double height = 10, crown_radius = 3;
  PlantKind kind = PlantKind::broadleaf;
  std::optional<PlantSpecies> species = {};  ///< of that kind; none: any
  std::uint32_t attributes = 0;              ///< row of CityFeatures::attributes
};

/// What an ecosystem places: just so, of a model of its own.
struct PlacedPlant {
  Vec3d position{0, 0, 0};  ///< z: of its foot, above ground
  double height = 1, crown_radius = 1;
  double yaw = 0;           ///< radians about up
  std::uint16_t plant = 0;  ///< TreeInstance::plant
};

struct AreaFeature {
  std::string where;
  Polygon shape;
  Material kind = Material::grass;  ///< grass, park, wood, farmland, sand, water, pavement
  double trees_per_ha = 0;          ///< > 0: filled with trees
  PlantKind tree_kind = PlantKind::broadleaf;
  bool mixed = false;            ///< broadleaf and conifer
  std::uint32_t attributes = 0;  ///< row of CityFeatures::attributes
};

struct CityFeatures {
  LocalFrame frame;
  std::vector<BuildingFeature> buildings;
  std::vector<ConstructionFeature> constructions;
  std::vector<StreetFeature> streets;
  std::vector<TreeFeature> trees;
  std::vector<PlacedPlant> plants;
  std::vector<AreaFeature> areas;
  std::vector<Issue> issues;
  Pictures pictures;
  AttributeWriter attributes;  ///< what the file says of each; empty unless ImportOptions::attributes
  bool left_hand_traffic = false;
  std::string attribution;
};

}  // namespace manzana

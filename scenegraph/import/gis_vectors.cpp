#include "scenegraph/import/gis_vectors.h"

#include <algorithm>
#include <array>
#include <stdexcept>

bool manzana::is_gis_vectors(const std::filesystem::path& file) {
  constexpr std::array<const char*, 3> kKinds{".gpkg", ".geojson", ".shp"};
  return std::ranges::find(kKinds, file.extension()) != kKinds.end();
}

#ifndef MANZANA_GDAL

manzana::CityFeatures manzana::read_gis_vectors(const std::filesystem::path& file, const TreeColumns&,
                                                const ImportOptions&) {
  throw std::runtime_error(file.string() + ": this build is without GDAL (libgdal-dev), which reads such files");
}

#else

#include <ogrsf_frmts.h>

#include <cmath>
#include <limits>

#include "culling/hash.h"
#include "foliage/import/species.h"
#include "scenegraph/import/defaults.h"
#include "scenegraph/import/gdal_support.h"
#include "scenegraph/import/plan_geometry.h"
#include "scenegraph/import/tree_species.h"

namespace manzana {
namespace {

constexpr double kReach = 300e3;  // metres from the middle; what lies farther is a stray
constexpr int kUsualLevels = 3;

std::uint64_t hash_text(const std::string& text) {
  std::uint64_t hash = 0x615;
  for (const char c : text) hash = hash_bits(hash, static_cast<unsigned char>(c));
  return hash;
}

/// Degrees, as long as the frame is not known.
struct Found {
  std::vector<BuildingFeature> buildings;  // footprints: (longitude, latitude)
  std::vector<TreeFeature> trees;          // positions likewise
  std::vector<std::string> tree_places;    // for issues
  std::vector<Issue> issues;
  std::size_t others = 0;  // geometries of other kinds
};

/// Of a feature's attributes, by the first of the names that it has.
class Attributes {
 public:
  explicit Attributes(const OGRFeature& feature) : feature_(feature) {}
  std::string text(const std::string& named, std::initializer_list<const char*> usual) const {
    const int field = find(named, usual);
    return field < 0 ? "" : feature_.GetFieldAsString(field);
  }
  std::optional<double> number(const std::string& named, std::initializer_list<const char*> usual,
                               const Vec2d& range) const {
    const int field = find(named, usual);
    if (field < 0) return {};
    const double value = feature_.GetFieldAsDouble(field);
    return value >= range.x && value <= range.y ? std::optional(value) : std::nullopt;
  }
  /// All that are not null.
  std::uint32_t row(AttributeWriter& writer, const std::string& source) const {
    if (!writer.wanted()) return 0;
    std::vector<std::pair<std::string, std::string> > texts;
    for (int i = 0; i < feature_.GetFieldCount(); ++i)
      if (feature_.IsFieldSetAndNotNull(i))
        texts.emplace_back(feature_.GetFieldDefnRef(i)->GetNameRef(), feature_.GetFieldAsString(i));
    return writer.row(std::vector<AttributeWriter::Given>(texts.begin(), texts.end()), source);
  }

 private:
  int find(const std::string& named, std::initializer_list<const char*> usual) const {
    const auto set = [&](const char* name) {
      const int field = feature_.GetFieldIndex(name);
      return field >= 0 && feature_.IsFieldSetAndNotNull(field) ? field : -1;
    };
    if (!named.empty()) return set(named.c_str());
    for (const char* name : usual)
      if (const int field = set(name); field >= 0) return field;
    return -1;
  }
  const OGRFeature& feature_;
};

/// For issues, and by what the file knows it: ids of rows (FID) are not the same in each format.
struct Place {
  std::string where, source;
};

Place place_of(const OGRFeature& feature, const std::string& layer) {
  const std::string id = Attributes(feature).text("", {"id", "gml_id", "osm_id", "identificatie"}),
                    row = std::to_string(feature.GetFID());
  return id.empty() ? Place{layer + " " + row, layer + "/" + row} : Place{layer + " " + id, id};
}

class Reader {
 public:
  Reader(const TreeColumns& columns, const ImportOptions& options)
      : columns_(columns), options_(options), said_(options.attributes) {}

  CityFeatures run(GDALDataset& file) {
    for (OGRLayer* layer : file.GetLayers()) read(*layer);
    return take();
  }

 private:
  void read(OGRLayer& layer) {
    const OGRSpatialReference* own = layer.GetSpatialRef();
    const OGRSpatialReference from = own != nullptr ? *own : spatial_reference(options_.reference_system);
    const GeoTransform to_degrees(from);
    for (const auto& feature : layer) {
      const Attributes attributes(*feature);
      const Place place = place_of(*feature, layer.GetName());
      OGRGeometry* geometry = feature->GetGeometryRef();
      if (geometry == nullptr || geometry->IsEmpty()) {
        found_.issues.push_back({place.where, "has no geometry"});
      } else if (!to_degrees.apply(*geometry)) {
        found_.issues.push_back({place.where, "not on the Earth"});
      } else {
        add(*geometry, attributes, place);
      }
    }
  }

  void add(const OGRGeometry& geometry, const Attributes& attributes, const Place& place) {
    switch (wkbFlatten(geometry.getGeometryType())) {
      case wkbPoint:
        return add_tree(*geometry.toPoint(), attributes, place);
      case wkbMultiPoint:
        for (const OGRPoint* point : *geometry.toMultiPoint()) add_tree(*point, attributes, place);
        return;
      case wkbPolygon:
        return add_building(*geometry.toPolygon(), attributes, place);
      case wkbMultiPolygon:
        for (const OGRPolygon* polygon : *geometry.toMultiPolygon()) add_building(*polygon, attributes, place);
        return;
      default:
        ++found_.others;
    }
  }

  static std::vector<Vec2d> ring_of(const OGRLinearRing& ring) {
    std::vector<Vec2d> points;
    for (int i = 0; i + 1 < ring.getNumPoints(); ++i) points.emplace_back(ring.getX(i), ring.getY(i));
    return points;
  }

  void add_building(const OGRPolygon& polygon, const Attributes& attributes, const Place& place) {
    if (polygon.getExteriorRing() == nullptr) return;
    BuildingFeature& building = found_.buildings.emplace_back();
    building.where = place.where;
    building.attributes = attributes.row(said_, place.source);
    building.footprint.outer = ring_of(*polygon.getExteriorRing());
    for (int i = 0; i < polygon.getNumInteriorRings(); ++i)
      building.footprint.holes.push_back(ring_of(*polygon.getInteriorRing(i)));
    // What is not told is filled in when the footprint is known in metres.
    building.height =
        attributes.number("", {"height", "HEIGHT", "measuredHeight", "h_dak_max"}, {0.5, 1000}).value_or(0);
    building.levels = static_cast<int>(
        attributes.number("", {"levels", "building:levels", "building_levels", "storeys"}, {1, 300}).value_or(0));
    kinds_.push_back(attributes.text("", {"class", "building", "type"}));
  }

  void add_tree(const OGRPoint& point, const Attributes& attributes, const Place& place) {
    const std::string name = attributes.text(columns_.species, {"species", "genus"});
    TreeFeature& tree = found_.trees.emplace_back();
    const std::uint64_t id = hash_text(place.where);
    tree.position = {point.getX(), point.getY()};
    tree.attributes = attributes.row(said_, place.source);
    tree.species = species_named(name).value_or(species_for(PlantKind::broadleaf, TreePlace::park, id));
    for (std::size_t i = 0; i < kPlantSpecies; ++i)
      if (name == foliage::kSpeciesNames[i]) tree.species = static_cast<PlantSpecies>(i);
    tree.kind = kind_of(*tree.species);
    tree.height =
        attributes.number(columns_.height, {"height", "HEIGHT"}, {0.3, 120}).value_or(tree_height(*tree.species, id));
    const auto crown = attributes.number(columns_.crown, {"crown", "CROWN"}, {0.1, 60});
    tree.crown_radius = crown ? *crown / 2 : crown_radius(*tree.species, tree.height);
    found_.tree_places.push_back(place.where);
  }

  /// Levels, height, roof and colours, as OpenStreetMap's buildings have them.
  static void complete(BuildingFeature& building, const std::string& kind) {
    const std::vector<Vec2d>& ring = building.footprint.outer;
    BuildingSite site;
    site.kind = kind.empty() ? std::string_view("yes") : kind;
    site.id = hash_text(building.where);
    site.area = plan::area(building.footprint);
    site.corners = ring.size();
    for (std::size_t i = 0; i < ring.size(); ++i) site.perimeter += glm::distance(ring[i], ring[(i + 1) % ring.size()]);
    const bool told = building.height > 0;
    if (building.levels == 0)
      building.levels = told
                            ? std::max(1, static_cast<int>(std::lround((building.height - kGroundRise) / kLevelHeight)))
                            : levels_of(site, kUsualLevels);
    building.roof = roof_of(site, building.levels);
    building.roof_height =
        roof_height_of(site, building.roof, told ? building.height : std::numeric_limits<double>::infinity());
    if (!told) building.height = kGroundRise + kLevelHeight * building.levels + building.roof_height;
    building.wall_rgb = wall_colour_of(site);
    building.roof_rgb = roof_colour_of(site, building.roof);
  }

  CityFeatures take() {
    CityFeatures city;
    city.issues = std::move(found_.issues);
    city.attributes = std::move(said_);
    if (found_.others > 0)
      city.issues.push_back({"file", std::to_string(found_.others) + " geometries that are neither polygon nor point"});
    std::vector<GeoPoint> places;
    for (const BuildingFeature& b : found_.buildings)
      for (const Vec2d& p : b.footprint.outer) places.push_back({p.y, p.x, 0});
    for (const TreeFeature& tree : found_.trees) places.push_back({tree.position.y, tree.position.x, 0});
    if (places.empty()) city.issues.push_back({"file", "holds nothing that can be drawn"});
    city.frame = LocalFrame(median_of(places));
    for (std::size_t i = 0; i < found_.buildings.size(); ++i) lay(city, std::move(found_.buildings[i]), kinds_[i]);
    for (std::size_t i = 0; i < found_.trees.size(); ++i) {
      TreeFeature tree = found_.trees[i];
      tree.position = plan(city, tree.position);
      keep(city, city.trees, std::move(tree), tree.position, found_.tree_places[i]);
    }
    return city;
  }

  static Vec2d plan(const CityFeatures& city, const Vec2d& degrees) {
    return Vec2d(city.frame.to_local({degrees.y, degrees.x, 0}));
  }
  template <class Feature>
  static void keep(CityFeatures& city, std::vector<Feature>& list, Feature feature, const Vec2d& at,
                   const std::string& where) {
    if (glm::length(at) <= kReach) return list.push_back(std::move(feature));
    city.issues.push_back({where, "too far from the rest of the data"});
  }
  static void lay(CityFeatures& city, BuildingFeature building, const std::string& kind) {
    if (building.footprint.outer.size() < 3) return city.issues.push_back({building.where, "fewer than three points"});
    for (Vec2d& p : building.footprint.outer) p = plan(city, p);
    for (auto& hole : building.footprint.holes)
      for (Vec2d& p : hole) p = plan(city, p);
    complete(building, kind);
    const Vec2d at = building.footprint.outer[0];
    const std::string where = building.where;
    keep(city, city.buildings, std::move(building), at, where);
  }

  const TreeColumns& columns_;
  const ImportOptions& options_;
  AttributeWriter said_;
  Found found_;
  std::vector<std::string> kinds_;
};

}  // namespace

CityFeatures read_gis_vectors(const std::filesystem::path& file, const TreeColumns& columns,
                              const ImportOptions& options) {
  try {
    const GdalFile dataset(file, GDAL_OF_VECTOR, {"GPKG", "GeoJSON", "ESRI Shapefile"});
    return Reader(columns, options).run(*dataset);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

}  // namespace manzana

#endif

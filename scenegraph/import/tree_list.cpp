#include "scenegraph/import/tree_list.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

#include "culling/hash.h"
#include "files/whole_file.h"
#include "scenegraph/import/csv_rows.h"
#include "scenegraph/import/defaults.h"
#include "scenegraph/import/gis_vectors.h"
#include "scenegraph/import/json_text.h"
#include "scenegraph/import/osm_values.h"
#include "scenegraph/import/plan_geometry.h"
#include "scenegraph/import/reference_system.h"
#include "scenegraph/import/tree_species.h"

namespace manzana {
namespace {

using Json = nlohmann::json;

constexpr std::uint64_t kMostBytes = 256ULL << 20;
constexpr double kReach = 300e3;  // metres from the middle; what lies farther is a stray

/// Digits and a point: a comma in a list may be a thousand's as well as a decimal's.
std::optional<double> number(std::string_view text) {
  text = trimmed(text);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
  return whole ? std::optional(value) : std::nullopt;
}

/// What a row says of a tree, as it is written.
struct Entry {
  std::string where, species = {}, height = {}, crown = {};
  std::optional<double> crown_m = {};  ///< of the outline, where there is one
  std::uint32_t attributes = 0;
};

class TreeReader {
 public:
  TreeReader(ReferenceSystem system, bool attributes) : system_(std::move(system)) {
    city_.attributes = AttributeWriter(attributes);
  }
  AttributeWriter& attributes() { return city_.attributes; }

  void add(const Vec2d& xy, const Entry& entry) {
    const auto place = system_.to_geo({xy, 0});
    if (!place || std::abs(place->lon_deg) > 180) return refuse(entry, "not on the Earth");
    places_.push_back(*place);
    where_.push_back(entry.where);
    city_.trees.push_back(tree_of(entry));
  }
  void refuse(const Entry& entry, const std::string& what) { city_.issues.push_back({entry.where, what}); }

  CityFeatures take() {
    city_.frame = LocalFrame(median_of(places_));
    std::size_t kept = 0;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const Vec3d p = city_.frame.to_local({places_[i].lat_deg, places_[i].lon_deg, 0});
      city_.trees[i].position = Vec2d(p);
      if (glm::length(p) <= kReach)
        city_.trees[kept++] = city_.trees[i];
      else
        city_.issues.push_back({where_[i], "too far from the rest of the trees"});
    }
    city_.trees.resize(kept);
    if (kept == 0) city_.issues.push_back({"file", "holds no trees"});
    return std::move(city_);
  }

 private:
  std::optional<double> metres(const Entry& entry, const std::string& text, const char* what, Vec2d range) {
    if (trimmed(text).empty()) return {};
    const auto value = number(text);
    if (value && *value >= range.x && *value <= range.y) return value;
    refuse(entry, std::string(what) + " '" + text.substr(0, 40) + "' is of no use; by rule");
    return {};
  }

  TreeFeature tree_of(const Entry& entry) {
    const std::uint64_t id = hash_bits(0x7ee1157, city_.trees.size());
    TreeFeature tree;
    tree.species =
        species_named(trimmed(entry.species)).value_or(species_for(PlantKind::broadleaf, TreePlace::park, id));
    tree.kind = kind_of(*tree.species);
    tree.height = metres(entry, entry.height, "height", {0.3, 120}).value_or(tree_height(*tree.species, id));
    auto crown = metres(entry, entry.crown, "crown", {0.1, 60});
    if (!crown) crown = entry.crown_m;
    tree.crown_radius = crown ? *crown / 2 : crown_radius(*tree.species, tree.height);
    tree.attributes = entry.attributes;
    return tree;
  }

  ReferenceSystem system_;
  CityFeatures city_;
  std::vector<GeoPoint> places_;
  std::vector<std::string> where_;
};

/// The column that was named; else the first of its usual names.
class Columns {
 public:
  explicit Columns(const CsvRows& rows) : rows_(rows) {}
  std::optional<std::size_t> find(const std::string& named, std::initializer_list<const char*> usual) const {
    if (!named.empty()) {
      if (const auto column = rows_.column(named)) return column;
      throw std::runtime_error("has no column '" + named.substr(0, 80) + "'");
    }
    for (const char* name : usual)
      if (const auto column = rows_.column(name)) return column;
    return {};
  }

 private:
  const CsvRows& rows_;
};

/// Columns that are not empty.
std::uint32_t row_of(const std::vector<std::string>& names, const std::vector<std::string>& fields,
                     const std::string& source, AttributeWriter& attributes) {
  std::vector<AttributeWriter::Given> given;
  for (std::size_t i = 0; attributes.wanted() && i < names.size(); ++i)
    if (!fields[i].empty()) given.emplace_back(names[i], fields[i]);
  return attributes.row(given, source);
}

CityFeatures read_csv(std::string_view bytes, const TreeColumns& names, const ImportOptions& options) {
  CsvRows rows(bytes);
  const Columns columns(rows);
  auto x = columns.find(names.lon, {"longitude", "lon", "lng"}), y = columns.find(names.lat, {"latitude", "lat"});
  const bool degrees = names.x.empty() && names.y.empty() && x && y;
  if (!degrees) x = columns.find(names.x, {"x", "X"}), y = columns.find(names.y, {"y", "Y"});
  if (!x || !y) throw std::runtime_error("no columns of places: name them, lat=NAME,lon=NAME or x=NAME,y=NAME");
  const auto species = columns.find(names.species, {"species"});
  const auto height = columns.find(names.height, {"height"}), crown = columns.find(names.crown, {"crown"}),
             id = columns.find("", {"id", "gml_id", "osm_id"});

  TreeReader trees(ReferenceSystem(degrees ? "EPSG:4326" : options.reference_system), options.attributes);
  if (!degrees && options.reference_system.empty())
    trees.refuse({.where = "file"}, "x and y without a reference system: laid at latitude 0, longitude 0");
  for (CsvRow row; rows.next(row);) {
    const auto text = [&](const std::optional<std::size_t>& column) { return column ? row.fields[*column] : ""; };
    Entry entry{.where = "line " + std::to_string(row.line)};
    if (row.open_quote)
      trees.refuse(entry, "a quote is not closed");
    else if (row.fields.size() < rows.header().size())
      trees.refuse(entry, "fewer columns than the header");
    else {
      const auto east = number(row.fields[*x]), north = number(row.fields[*y]);
      entry.attributes = row_of(rows.header(), row.fields, text(id), trees.attributes());
      entry.species = text(species), entry.height = text(height), entry.crown = text(crown);
      if (east && north)
        trees.add({*east, *north}, entry);
      else
        trees.refuse(entry, "a coordinate is no number");
    }
  }
  return trees.take();
}

const Json* member(const Json& json, const char* name) {
  const auto found = json.is_object() ? json.find(name) : json.end();
  return found == json.end() ? nullptr : &*found;
}

std::string text_of(const Json* json) {
  if (json == nullptr || json->is_null() || json->is_structured()) return {};
  return json->is_string() ? json->get<std::string>() : json->dump();
}

/// A feature's own id [RFC 7946, 3.2], else that among its properties.
std::string source_of(const Json& feature, const Json* properties) {
  const std::string id = text_of(member(feature, "id"));
  return id.empty() && properties != nullptr ? text_of(member(*properties, "id")) : id;
}

std::uint32_t row_of(const Json& feature, const Json* properties, AttributeWriter& attributes) {
  if (!attributes.wanted()) return 0;
  std::vector<std::pair<std::string, std::string>> texts;
  if (properties == nullptr || !properties->is_object()) return attributes.row({}, source_of(feature, nullptr));
  for (const auto& [name, value] : properties->items())
    if (!value.is_null()) texts.emplace_back(name, value.is_string() ? value.get<std::string>() : value.dump());
  return attributes.row(std::vector<AttributeWriter::Given>(texts.begin(), texts.end()),
                        source_of(feature, properties));
}

Vec2d position_of(const Json& json) {
  const bool two = json.is_array() && json.size() >= 2 && json[0].is_number() && json[1].is_number();
  if (!two) throw std::runtime_error("a position is not of two numbers");
  return {json[0].get<double>(), json[1].get<double>()};
}

const Json& array_of(const Json& json) {
  if (!json.is_array() || json.empty()) throw std::runtime_error("a geometry is empty");
  return json;
}

class GeoJsonReader {
 public:
  GeoJsonReader(const TreeColumns& names, const std::string& system, bool attributes)
      : names_(names), trees_(ReferenceSystem(system), attributes) {}

  void feature(const Json& json, std::size_t number) {
    const Json* properties = member(json, "properties");
    const auto text = [&](const std::string& named, const char* usual) {
      return properties == nullptr ? "" : text_of(member(*properties, named.empty() ? usual : named.c_str()));
    };
    Entry entry{"feature " + std::to_string(number), text(names_.species, "species"), text(names_.height, "height"),
                text(names_.crown, "crown")};
    entry.attributes = row_of(json, properties, trees_.attributes());
    try {
      const Json* geometry = member(json, "geometry");
      const Json* coordinates = geometry == nullptr ? nullptr : member(*geometry, "coordinates");
      if (coordinates == nullptr) throw std::runtime_error("has no geometry");
      place(text_of(member(*geometry, "type")), array_of(*coordinates), entry);
    } catch (const std::runtime_error& error) {
      trees_.refuse(entry, error.what());
    }
  }
  CityFeatures take() { return trees_.take(); }

 private:
  void place(const std::string& type, const Json& coordinates, const Entry& entry) {
    if (type == "Point") return trees_.add(position_of(coordinates), entry);
    if (type == "Polygon") return crown(array_of(coordinates[0]), entry);
    if (type != "MultiPoint" && type != "MultiPolygon")
      throw std::runtime_error("of another geometry than points and crowns");
    for (const Json& part : coordinates)
      type == "MultiPoint" ? trees_.add(position_of(part), entry) : crown(array_of(array_of(part)[0]), entry);
  }

  /// The outline of a crown: the tree stands at its centroid.
  void crown(const Json& ring, Entry entry) {
    std::vector<Vec2d> outline;
    for (const Json& p : ring) outline.push_back(position_of(p));
    const double area = std::abs(plan::area(outline));
    if (!(area > 0)) throw std::runtime_error("an outline without area");
    const double diameter = 2 * std::sqrt(area / std::numbers::pi);
    const bool metres = diameter > 0.1 && diameter < 60;  // in degrees it is none
    if (metres) entry.crown_m = diameter;
    trees_.add(plan::centroid(outline), entry);
  }

  const TreeColumns& names_;
  TreeReader trees_;
};

std::string system_of(const Json& json, const std::string& otherwise) {
  const Json* crs = member(json, "crs");
  const Json* properties = crs == nullptr ? nullptr : member(*crs, "properties");
  const std::string named = properties == nullptr ? "" : text_of(member(*properties, "name"));
  if (!named.empty()) return named;
  return otherwise.empty() ? "EPSG:4326" : otherwise;
}

CityFeatures read_geojson(std::string_view bytes, const TreeColumns& names, const ImportOptions& options) {
  const Json json = parse_shallow_json(bytes);
  const Json* features = member(json, "features");
  if (features == nullptr || !features->is_array()) throw std::runtime_error("is no GeoJSON: no \"features\"");
  GeoJsonReader reader(names, system_of(json, options.reference_system), options.attributes);
  for (std::size_t i = 0; i < features->size(); ++i) reader.feature((*features)[i], i + 1);
  return reader.take();
}

}  // namespace

CityFeatures read_tree_bytes(std::string_view bytes, bool geojson, const TreeColumns& columns,
                             const ImportOptions& options) {
  return geojson ? read_geojson(bytes, columns, options) : read_csv(bytes, columns, options);
}

CityFeatures read_tree_list(const std::filesystem::path& file, const TreeColumns& columns,
                            const ImportOptions& options) {
  if (file.extension() != ".geojson" && is_gis_vectors(file)) return read_gis_vectors(file, columns, options);
  try {
    const auto bytes = files::read_whole(file, kMostBytes);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return read_tree_bytes(text, file.extension() == ".geojson" || file.extension() == ".json", columns, options);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

}  // namespace manzana

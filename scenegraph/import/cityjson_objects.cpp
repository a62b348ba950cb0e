#include "scenegraph/import/cityjson_objects.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <unordered_map>

#include "scenegraph/import/defaults.h"
#include "scenegraph/import/tree_species.h"

namespace manzana::cityjson {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMostInstanced = 30'000'000;  // corners that instances make, in all
constexpr int kDeepest = 16;                        // generations of parents

bool finite(const Vec3d& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// FNV-1a: the same on every machine.
std::uint64_t hash_of(std::string_view text) {
  std::uint64_t h = 0xcbf29ce484222325ULL;
  for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return h;
}

std::string where_of(const Json& json, const std::string& id) {
  const std::string type = text_of(member(json, "type"));
  return (type.empty() ? "object" : type) + " " + id.substr(0, 100);
}

const Json* attribute(const Json& json, const char* name) {
  const Json* attributes = member(json, "attributes");
  return attributes == nullptr ? nullptr : member(*attributes, name);
}

std::optional<double> length(const Json& json, const char* name, double low, double high) {
  const Json* value = attribute(json, name);
  if (value != nullptr && value->is_object()) value = member(*value, "value");
  if (value == nullptr || !value->is_number()) return {};
  const auto metres = value->get<double>();
  return metres >= low && metres <= high ? std::optional(metres) : std::nullopt;
}

bool speaks_of(const Json& json, std::span<const std::string_view> words) {
  for (const char* name : {"class", "function", "usage"}) {
    std::string text = text_of(attribute(json, name));
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return c < 128 ? std::tolower(c) : c; });
    if (std::ranges::any_of(words, [&](std::string_view word) { return text.find(word) != std::string::npos; }))
      return true;
  }
  return false;
}

// English, Dutch, German: those that publish cities.
constexpr std::array<std::string_view, 8> kFootways{"foot", "pedestrian", "sidewalk", "cycle",
                                                    "voet", "fiets",      "geh",      "rad"};
constexpr std::array<std::string_view, 4> kWoods{"forest", "wood", "bos", "wald"};

Material ground_of(const Json& json, const std::string& type) {
  if (type == "WaterBody" || type == "Waterway") return Material::water;
  if (type == "PlantCover") return speaks_of(json, kWoods) ? Material::wood : Material::park;
  if (type == "LandUse") return speaks_of(json, kWoods) ? Material::wood : Material::grass;
  if (type == "Road") return speaks_of(json, kFootways) ? Material::pavement : Material::junction;
  return Material::pavement;  // Railway, TransportSquare
}

FaceKind kind_of_surface(const std::string& type) {
  if (type == "RoofSurface") return FaceKind::roof;
  if (type == "WallSurface" || type == "OuterCeilingSurface" || type == "ClosureSurface") return FaceKind::wall;
  if (type == "GroundSurface" || type == "OuterFloorSurface") return FaceKind::floor;
  if (type == "Window") return FaceKind::window;
  if (type == "Door") return FaceKind::door;
  if (type == "AuxiliaryTrafficArea") return FaceKind::paved;
  if (type == "InteriorWallSurface" || type == "CeilingSurface" || type == "FloorSurface") return FaceKind::inner;
  return FaceKind::untold;
}

std::vector<FaceKind> kinds_of(const Json& geometry) {
  std::vector<FaceKind> kinds;
  const Json* semantics = member(geometry, "semantics");
  const Json* surfaces = semantics == nullptr ? nullptr : member(*semantics, "surfaces");
  if (surfaces == nullptr || !surfaces->is_array()) return kinds;
  for (const Json& surface : *surfaces) kinds.push_back(kind_of_surface(text_of(member(surface, "type"))));
  return kinds;
}

std::vector<Vec3d> coordinates(const Json* json, const Vec3d& scale, const Vec3d& translate) {
  std::vector<Vec3d> points;
  if (json == nullptr || !json->is_array()) return points;
  points.reserve(json->size());
  for (const Json& v : *json) {
    const bool three = v.is_array() && v.size() >= 3 && v[0].is_number() && v[1].is_number() && v[2].is_number();
    points.push_back(three ? Vec3d(v[0].get<double>(), v[1].get<double>(), v[2].get<double>()) * scale + translate
                           : Vec3d(kNaN));
  }
  return points;
}

std::string title_of(const Json& header) {
  const Json* metadata = member(header, "metadata");
  if (metadata == nullptr) return {};
  const std::string title = text_of(member(*metadata, "title"));
  const Json* contact = member(*metadata, "pointOfContact");
  const std::string name = contact == nullptr ? "" : text_of(member(*contact, "contactName"));
  return title.empty() || name.empty() || title == name ? title + name : title + ", " + name;
}

std::string system_of(const Json& header, const std::string& otherwise) {
  const Json* metadata = member(header, "metadata");
  const std::string named = metadata == nullptr ? "" : text_of(member(*metadata, "referenceSystem"));
  return named.empty() ? otherwise : named;
}

void check_version(const Json& header) {
  if (text_of(member(header, "type")) != "CityJSON")
    throw std::runtime_error("is no CityJSON: no \"type\": \"CityJSON\"");
  const std::string version = text_of(member(header, "version"));
  if (!version.starts_with("1.0") && !version.starts_with("1.1") && !version.starts_with("2.0"))
    throw std::runtime_error("is CityJSON " + version.substr(0, 20) + "; 1.0 to 2.0 are read");
}

std::uint32_t row_of(const std::vector<std::pair<std::string, std::string>>& said, const std::string& source,
                     AttributeWriter& attributes) {
  return attributes.row(std::vector<AttributeWriter::Given>(said.begin(), said.end()), source);
}

/// Up the first parents, as far as they are in the document and no groups; empty where they go round.
std::string root_of(const Json& objects, const std::string& id) {
  std::string root = id;
  for (int i = 0; i < kDeepest; ++i) {
    const std::string parent = text_of(member(objects[root], "parents"));
    const Json* above = parent.empty() ? nullptr : member(objects, parent.c_str());
    if (above == nullptr || text_of(member(*above, "type")) == "CityObjectGroup") return root;
    root = parent;
  }
  return {};  // they go round
}

}  // namespace

Role role_of(const std::string& type) {
  constexpr std::array<std::string_view, 4> kInner{"Room", "Unit", "Storey", "Furniture"};
  const auto is = [&](std::initializer_list<std::string_view> those) {
    return std::ranges::find(those, type) != those.end();
  };
  if (type == "CityFurniture") return Role::work;
  if (type.starts_with("Tunnel") || type == "CityObjectGroup") return Role::inner;
  if (std::ranges::any_of(kInner, [&](std::string_view end) { return type.ends_with(end); })) return Role::inner;
  if (type.starts_with("Building")) return Role::building;
  if (type.starts_with("Bridge") || type.starts_with("+") || is({"OtherConstruction", "GenericCityObject"}))
    return Role::work;
  if (is({"LandUse", "PlantCover", "WaterBody", "Waterway", "Road", "Railway", "TransportSquare"})) return Role::ground;
  if (type == "TINRelief") return Role::terrain;
  return type == "SolitaryVegetationObject" ? Role::tree : Role::unknown;
}

Intake::Intake(const Json& header, const ImportOptions& options, std::optional<std::filesystem::path> folder)
    : options_(options),
      system_((check_version(header), system_of(header, options.reference_system))),
      folder_(std::move(folder)) {
  if (const Json* transform = member(header, "transform")) {
    const auto need = [&](const char* name) {
      const Json* found = member(*transform, name);
      if (found == nullptr) throw std::runtime_error(std::string("transform.") + name + " is missing");
      return vec3_of(*found, (std::string("transform.") + name).c_str());
    };
    scale_ = need("scale");
    translate_ = need("translate");
    if (!glm::all(glm::greaterThan(scale_, Vec3d(0))))
      throw std::runtime_error("transform.scale is not of positive numbers");
  }
  if (system_of(header, options.reference_system).empty())
    out_.issues.push_back({"file", "names no reference system: it is laid at latitude 0, longitude 0"});
  out_.attribution = title_of(header);
  out_.attributes = AttributeWriter(options.attributes);
  common_ = appearance_of(header, out_.issues);
  read_templates(header);
}

void Intake::read_templates(const Json& header) {
  const Json* all = member(header, "geometry-templates");
  const Json* templates = all == nullptr ? nullptr : member(*all, "templates");
  if (templates == nullptr || !templates->is_array()) return;
  templates_ = *templates;
  template_vertices_ = coordinates(member(*all, "vertices-templates"), Vec3d(1), Vec3d(0));
}

Vec3d Intake::geo(const Vec3d& file) {
  const auto place = finite(file) ? system_.to_geo(file) : std::nullopt;
  return place ? Vec3d(place->lat_deg, place->lon_deg, place->height_m) : Vec3d(kNaN);
}

Vertices Intake::vertices_of(const Json& document) {
  Vertices vertices{coordinates(member(document, "vertices"), scale_, translate_), {}};
  for (const Vec3d& p : vertices.file) vertices.geo.push_back(geo(p));
  return vertices;
}

void Intake::add(const Json& document) {
  const Json* objects = member(document, "CityObjects");
  if (objects == nullptr || !objects->is_object()) throw std::runtime_error("CityObjects is no object");
  const Vertices vertices = vertices_of(document);
  const bool feature = text_of(member(document, "type")) == "CityJSONFeature";
  if (feature) own_ = appearance_of(document, out_.issues);
  looks_ = feature && member(document, "appearance") != nullptr ? &own_ : &common_;
  work_at_.clear();
  for (const auto& [id, json] : objects->items()) {
    try {
      object(*objects, id, json, vertices);
    } catch (const Json::exception&) {
      out_.issues.push_back({where_of(json, id), "a value is of the wrong type"});
    } catch (const std::runtime_error& error) {
      out_.issues.push_back({where_of(json, id), error.what()});
    }
  }
}

double Intake::lod(const Json& geometry) const {
  const Json* number = member(geometry, "template");
  const bool known =
      number != nullptr && number->is_number_unsigned() && number->get<std::size_t>() < templates_.size();
  return lod_of(known ? templates_[number->get<std::size_t>()] : geometry);
}

std::vector<const Json*> Intake::chosen(const Json& json) const {
  const Json* geometries = member(json, "geometry");
  if (geometries == nullptr || !geometries->is_array() || geometries->empty()) return {};
  double best = -1, lowest = std::numeric_limits<double>::infinity();
  for (const Json& geometry : *geometries) {
    const double level = lod(geometry);
    lowest = std::min(lowest, level);
    if (level <= options_.lod) best = std::max(best, level);
  }
  if (best < 0) best = lowest;
  std::vector<const Json*> those;
  for (const Json& geometry : *geometries)
    if (lod(geometry) == best) those.push_back(&geometry);
  return those;
}

void Intake::object(const Json& objects, const std::string& id, const Json& json, const Vertices& vertices) {
  const std::string type = text_of(member(json, "type"));
  const Role role = role_of(type);
  if (role == Role::unknown) throw std::runtime_error("an unknown type");
  if (role == Role::inner) return;
  if (role == Role::tree) return plant(id, json, vertices);
  const bool stands = role == Role::building || role == Role::work;
  std::string root = stands ? root_of(objects, id) : id;
  if (root.empty()) out_.issues.push_back({where_of(json, root = id), "its parents go round; taken for itself"});
  Work& work = work_of(objects, root, role);
  if (root != id) note(json, work.said);
  if (role == Role::ground) work.ground = ground_of(json, type);
  for (const Json* geometry : chosen(json)) {
    const bool footprint = role == Role::building && lod(*geometry) < 1 && member(*geometry, "lod") != nullptr;
    if (!footprint) append(work, *geometry, vertices);
  }
}

Work& Intake::work_of(const Json& objects, const std::string& root, Role role) {
  const auto [at, fresh] = work_at_.try_emplace(root, static_cast<std::uint32_t>(out_.works.size()));
  if (!fresh) return out_.works[at->second];
  Work& work = out_.works.emplace_back();
  work.role = role;
  work.id = hash_of(root);
  work.source = root;
  work.shape.where = where_of(objects[root], root);
  note(objects[root], work.said);
  return work;
}

Collected Intake::take() {
  worn_.paint(folder_, out_.issues, out_.pictures,
              [&](const OnPicture& part, std::uint32_t rgb, std::uint32_t texture) {
                const auto [at, face] = surfaces_[part.surface];
                Work& work = out_.works[at];
                work.colour[face] = rgb;
                wear(work.shape, face, work.number, part, texture);
              });
  for (Work& work : out_.works) work.shape.attributes = row_of(work.said, work.source, out_.attributes);
  return std::move(out_);
}

void Intake::note(const Json& json, std::vector<std::pair<std::string, std::string>>& said) const {
  if (!out_.attributes.wanted()) return;
  said.emplace_back("type", text_of(member(json, "type")));
  const Json* attributes = member(json, "attributes");
  if (attributes == nullptr || !attributes->is_object()) return;
  for (const auto& [name, value] : attributes->items())
    if (!value.is_null()) said.emplace_back(name, value.is_string() ? value.get<std::string>() : value.dump());
}

void Intake::append(Work& work, const Json& geometry, const Vertices& vertices) {
  if (text_of(member(geometry, "type")) != "GeometryInstance")
    return append(work, surfaces_of(geometry, vertices.file.size()), geometry, vertices.geo, *looks_);
  const Instance instance = instance_of(geometry, templates_.size(), vertices.file.size());
  const Json& shape = templates_[instance.geometry];
  const Surfaces surfaces = surfaces_of(shape, template_vertices_.size());
  points_ += surfaces.corners.size();
  if (points_ > kMostInstanced) throw std::runtime_error("instances make more than 30 million corners");
  std::vector<Vec3d> placed(template_vertices_.size(), Vec3d(kNaN));
  for (const std::uint32_t c : surfaces.corners)
    placed[c] = geo(vertices.file[instance.vertex] + instance(template_vertices_[c]));
  append(work, surfaces, shape, placed, common_);
}

void Intake::append(Work& work, const Surfaces& surfaces, const Json& geometry, const std::vector<Vec3d>& points,
                    const Appearance& looks) {
  if (std::ranges::any_of(surfaces.corners, [&](std::uint32_t c) { return !finite(points[c]); }))
    throw std::runtime_error("a vertex is not finite, or its reference system does not hold there");
  ConstructionFeature& shape = work.shape;
  const auto rings = static_cast<std::uint32_t>(shape.ring_last.size()),
             faces = static_cast<std::uint32_t>(shape.faces.size());
  const auto corners = static_cast<std::uint32_t>(shape.corners.size());
  std::unordered_map<std::uint32_t, std::uint32_t> own;
  for (const std::uint32_t c : surfaces.corners) {
    const auto [at, fresh] = own.try_emplace(c, static_cast<std::uint32_t>(shape.points.size()));
    if (fresh) shape.points.push_back(points[c]);
    shape.corners.push_back(at->second);
  }
  std::ranges::copy(surfaces.number, std::back_inserter(work.number));
  for (const std::uint32_t last : surfaces.ring_last) shape.ring_last.push_back(corners + last);
  for (const std::uint32_t last : surfaces.part_last) shape.part_last.push_back(faces + last);
  const std::vector<FaceKind> kinds = kinds_of(geometry);
  for (const Surfaces::Face& face : surfaces.faces) {
    shape.faces.push_back({.last_ring = rings + face.last_ring});
    work.kinds.push_back(face.semantic < kinds.size() ? kinds[face.semantic] : FaceKind::untold);
  }
  dress(work, geometry, looks);
}

/// The faces of the geometry, which are the last.
void Intake::dress(Work& work, const Json& geometry, const Appearance& looks) {
  std::ranges::copy(materials_of(geometry, looks), std::back_inserter(work.colour));
  if (work.role == Role::ground || work.role == Role::terrain) return;  // drawn by their kind
  if (!worn_.add(geometry, looks, static_cast<std::uint32_t>(surfaces_.size()))) return;
  const auto at = static_cast<std::uint32_t>(&work - out_.works.data());
  const auto last = static_cast<std::uint32_t>(work.colour.size());
  for (auto face = last - static_cast<std::uint32_t>(value_of_each(geometry, nullptr).size()); face < last; ++face)
    surfaces_.emplace_back(at, face);
}

void Intake::plant(const std::string& id, const Json& json, const Vertices& vertices) {
  Vec3d low(std::numeric_limits<double>::infinity()), high = -low;
  const auto add = [&](const Vec3d& p) { low = glm::min(low, p), high = glm::max(high, p); };
  for (const Json* geometry : chosen(json)) {
    if (text_of(member(*geometry, "type")) == "GeometryInstance") {
      const Instance instance = instance_of(*geometry, templates_.size(), vertices.file.size());
      const Vec3d& at = vertices.file[instance.vertex];
      const Json& shape = templates_[instance.geometry];
      for (const std::uint32_t c : surfaces_of(shape, template_vertices_.size()).corners)
        add(at + instance(template_vertices_[c]));
      add(at + instance(Vec3d(0)));
    }
    for (const std::uint32_t c : surfaces_of(*geometry, vertices.file.size()).corners) add(vertices.file[c]);
    for (const std::uint32_t c : points_of(*geometry, vertices.file.size())) add(vertices.file[c]);
  }
  const Vec3d middle = low + (high - low) / 2.0;
  const Vec3d foot = geo({middle.x, middle.y, low.z}), top = geo({middle.x, middle.y, high.z});
  const Vec3d east = geo({high.x, middle.y, low.z}), north = geo({middle.x, high.y, low.z});
  if (!finite(foot) || !finite(top) || !finite(east) || !finite(north)) throw std::runtime_error("has no place");
  const LocalFrame here({foot.x, foot.y, 0});
  const auto reach = [&](const Vec3d& p) { return glm::length(Vec2d(here.to_local({p.x, p.y, 0}))); };
  const double height = top.z - foot.z, crown = (reach(east) + reach(north)) / 2;

  const std::string named = text_of(attribute(json, "species"));
  const std::uint64_t seed = hash_of(id);
  const PlantSpecies species = species_named(named).value_or(species_for(PlantKind::broadleaf, TreePlace::park, seed));
  StandingTree tree{{foot.x, foot.y, foot.z}, 0, 0, species};
  const auto told = length(json, "height", 0.3, 120), wide = length(json, "crownDiameter", 0.1, 60);
  const bool shaped = height >= 0.3 && height <= 120;
  tree.height = told ? *told : shaped ? height : tree_height(species, seed);
  const bool crowned = crown >= 0.05 && crown <= 30;
  tree.crown_radius = wide ? *wide / 2 : crowned ? crown : crown_radius(species, tree.height);
  std::vector<std::pair<std::string, std::string>> said;
  note(json, said);
  tree.attributes = row_of(said, id, out_.attributes);
  out_.trees.push_back(tree);
}

}  // namespace manzana::cityjson

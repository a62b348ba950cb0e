#pragma once
/// City objects on their way into features: taken from one document after another, while it is not yet known where the
/// frame lies. Points are (latitude, longitude, height of the file).
///   Intake intake(header, options);          // the first document: transform, reference system, templates
///   intake.add(header); intake.add(line);    // what cannot be used is listed
///   CityFeatures city = features_of(intake.take());
#include <optional>

#include "scenegraph/import/cityjson_looks.h"
#include "scenegraph/import/import.h"
#include "scenegraph/import/reference_system.h"

namespace manzana::cityjson {

enum class Role : std::uint8_t { building, work, ground, terrain, tree, inner, unknown };
Role role_of(const std::string& type);

/// What a face's semantics say.
enum class FaceKind : std::uint8_t { untold, wall, roof, floor, window, door, paved, inner };

/// A building with its parts, a bridge, a piece of ground: `shape` without kinds and colours yet.
struct Work {
  Role role = Role::work;
  std::uint64_t id = 0;  ///< seed of its looks
  std::string source;    ///< its name in the file
  Material ground = Material::grass;
  ConstructionFeature shape;
  std::vector<std::pair<std::string, std::string>> said;  ///< attributes, the root's first
  std::vector<FaceKind> kinds;                            ///< a row a face
  std::vector<std::uint32_t> colour;                      ///< a row a face: of its picture or material; kNone
  std::vector<std::uint32_t> number;                      ///< a row a corner: Surfaces::number
};

struct StandingTree {
  GeoPoint foot;
  double height = 0, crown_radius = 0;
  PlantSpecies species = PlantSpecies::broadleaf;
  std::uint32_t attributes = 0;
};

struct Collected {
  std::vector<Work> works;
  std::vector<StandingTree> trees;
  std::vector<Issue> issues;
  AttributeWriter attributes;
  Pictures pictures;
  std::string attribution;
};

/// In the file's coordinates. `geo`: as points are kept; not finite where the reference system does not hold.
struct Vertices {
  std::vector<Vec3d> file, geo;
};

class Intake {
 public:
  /// `folder`: of the pictures. Throws std::runtime_error where the header is no CityJSON 1.0 to 2.0.
  Intake(const Json& header, const ImportOptions& options, std::optional<std::filesystem::path> folder);
  /// A document or a feature. Throws where it has no objects at all.
  void add(const Json& document);
  Collected take();
  std::vector<Issue>& issues() { return out_.issues; }

 private:
  struct Template {
    Surfaces surfaces;
    const Json* geometry = nullptr;  ///< of templates_
  };
  Vec3d geo(const Vec3d& file);
  Vertices vertices_of(const Json& document);
  void read_templates(const Json& header);
  void object(const Json& objects, const std::string& id, const Json& json, const Vertices& vertices);
  void note(const Json& json, std::vector<std::pair<std::string, std::string>>& said) const;
  void plant(const std::string& id, const Json& json, const Vertices& vertices);
  Work& work_of(const Json& objects, const std::string& id, Role role);
  void append(Work& work, const Json& geometry, const Vertices& vertices);
  void append(Work& work, const Surfaces& surfaces, const Json& geometry, const std::vector<Vec3d>& points,
              const Appearance& looks);
  void dress(Work& work, const Json& geometry, const Appearance& looks);
  std::vector<const Json*> chosen(const Json& json) const;
  double lod(const Json& geometry) const;
  bool only_footprints(const Json& json) const;

  const ImportOptions& options_;
  ReferenceSystem system_;
  Vec3d scale_{1, 1, 1}, translate_{0, 0, 0};
  std::optional<std::filesystem::path> folder_;
  Appearance common_, own_;  // of the header, for templates too; of a feature
  const Appearance* looks_ = &common_;
  Worn worn_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> surfaces_;  // of what may wear pictures: a work and its face
  Json templates_;
  std::vector<Vec3d> template_vertices_;
  std::unordered_map<std::string, std::uint32_t> work_at_;  // of a document: by the root's id
  std::size_t points_ = 0;
  Collected out_;
};

/// Everything about the middle of it; see docs/cityjson.md for the rules.
CityFeatures features_of(Collected collected);

}  // namespace manzana::cityjson

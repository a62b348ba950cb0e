#include "foliage/import/obj_plant.h"

#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <stdexcept>
#include <unordered_map>

#include "files/whole_file.h"
#include "foliage/import/obj_lines.h"
#include "foliage/import/obj_materials.h"
#include "foliage/import/polygon.h"

namespace manzana::foliage {
namespace {

constexpr std::uint64_t kMaxObjBytes = 256U << 20;  // with its libraries and textures
constexpr std::size_t kMostParts = 200'000;

/// Numbers of a position, a texture coordinate and a normal; -1: none.
using Corner = std::array<std::int32_t, 3>;

struct CornerHash {
  std::size_t operator()(const Corner& c) const {
    std::uint64_t h = 0;
    for (const std::int32_t i : c) h = (h ^ static_cast<std::uint32_t>(i)) * 0x9e3779b97f4a7c15ULL, h ^= h >> 29;
    return static_cast<std::size_t>(h);
  }
};

/// What is of one group and one material.
struct Part {
  SourcePart source;
  std::unordered_map<Corner, std::uint32_t, CornerHash> known;
  bool normals_missing = false;
  std::int32_t group = 0;
};

class ObjReader {
 public:
  explicit ObjReader(FolderFiles& files) : materials_(files) {}

  void read(std::string_view text) {
    ObjLines lines(text);
    while (auto line = lines.next()) obey(*line);
  }

  PlantReading finish(const std::string& name) {
    std::vector<SourcePart> sources;
    for (Part& part : parts_) sources.push_back(finished(part));
    if (sources.empty()) throw std::runtime_error("has no triangles");
    PlantReading reading = assemble_plant(name, sources, materials_.taken());
    reading.notes = materials_.notes();
    return reading;
  }

 private:
  void obey(ObjLine& line) {
    const std::string_view word = line.word();
    if (word == "v") return add_position(line);
    if (word == "vt") return add_uv(line);
    if (word == "vn") return add_normal(line);
    if (word == "f") return add_face(line);
    if (word == "g" || word == "o") return begin_group(line.rest());
    if (word == "usemtl") return use_material(line.rest());
    if (word == "mtllib") return materials_.add_library(std::string(line.rest()));
  }

  template <class T>
  void check_room(const std::vector<T>& rows, const ObjLine& line) const {
    if (rows.size() >= kMaxSourceIndices) line.fail("more vertices than a plant may have");
  }

  void add_position(ObjLine& line) {
    check_room(positions_, line);
    const double x = line.need_number(), y = line.need_number(), z = line.need_number();
    positions_.emplace_back(x, -z, y);
  }

  void add_uv(ObjLine& line) {
    check_room(uvs_, line);
    const double u = line.need_number(), v = line.number_or(0);
    if (!(std::abs(u) < 1e6 && std::abs(v) < 1e6)) line.fail("a texture coordinate is out of range");
    uvs_.emplace_back(u, 1 - v);
  }

  void add_normal(ObjLine& line) {
    check_room(normals_, line);
    const double x = line.need_number(), y = line.need_number(), z = line.need_number();
    const Vec3d normal(x, -z, y);
    const double length = glm::length(normal);
    normals_.push_back(length > 1e-9 ? Vec3(normal / length) : Vec3(0, 0, 1));
  }

  void begin_group(std::string_view name) {
    group_name_ = name;
    part_ = nullptr;
  }

  void use_material(std::string_view name) {
    material_ = materials_.number(name);
    part_ = nullptr;
  }

  Part& part() {
    if (part_ != nullptr) return *part_;
    const auto group = static_cast<std::int32_t>(groups_.try_emplace(group_name_, groups_.size()).first->second);
    const auto [found, added] = part_of_.try_emplace({group, material_}, parts_.size());
    if (added) {
      if (parts_.size() >= kMostParts) throw std::runtime_error("more than 200000 groups");
      parts_.emplace_back();
      parts_.back().source.name = group_name_;
      parts_.back().source.material = material_;
      parts_.back().group = group;
    }
    part_ = &parts_[found->second];
    return *part_;
  }

  /// From 1, or from the end: -1 is the last. -1 where there is none.
  static std::int32_t index(std::string_view& word, std::size_t count, const char* what, const ObjLine& line) {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error == std::errc::invalid_argument) return -1;
    word.remove_prefix(static_cast<std::size_t>(end - word.data()));
    const auto size = static_cast<std::int64_t>(count);
    const std::int64_t at = value < 0 ? size + value : value - 1;
    if (error != std::errc() || value == 0 || at < 0 || at >= size || value < -size)
      line.fail(std::string("there is no ") + what + " " + std::to_string(value));
    return static_cast<std::int32_t>(at);
  }

  /// a, a/b, a//c, a/b/c
  Corner corner(std::string_view word, const ObjLine& line) const {
    const std::string_view whole = word;
    Corner out{-1, -1, -1};
    out[0] = index(word, positions_.size(), "vertex", line);
    if (word.starts_with('/')) {
      word.remove_prefix(1);
      out[1] = index(word, uvs_.size(), "texture coordinate", line);
      if (word.starts_with('/')) {
        word.remove_prefix(1);
        out[2] = index(word, normals_.size(), "normal", line);
      }
    }
    if (out[0] < 0 || !word.empty()) line.fail_word(whole, "is no corner of a face");
    return out;
  }

  void add_face(ObjLine& line) {
    corners_.clear();
    places_.clear();
    for (std::string_view word = line.word(); !word.empty(); word = line.word()) {
      corners_.push_back(corner(word, line));
      places_.push_back(positions_[static_cast<std::size_t>(corners_.back()[0])]);
    }
    if (corners_.size() < 3) line.fail("a face needs three corners");
    indices_ += 3 * (corners_.size() - 2);
    if (indices_ > kMaxSourceIndices) line.fail("more triangles than a plant may have");
    Part& to = part();
    for (const auto& triangle : triangulated(places_))
      for (const std::uint32_t i : triangle) to.source.indices.push_back(vertex(to, corners_[i]));
  }

  std::uint32_t vertex(Part& part, const Corner& c) {
    const auto [found, added] = part.known.try_emplace(c, static_cast<std::uint32_t>(part.source.positions.size()));
    if (!added) return found->second;
    if (++vertices_ > kMaxSourceVertices) throw std::runtime_error("more vertices than a plant may have");
    const auto at = [](std::int32_t i) { return static_cast<std::size_t>(i); };
    part.source.positions.push_back(positions_[at(c[0])]);
    part.source.uvs.push_back(c[1] < 0 ? Vec2(0) : uvs_[at(c[1])]);
    part.source.normals.push_back(c[2] < 0 ? Vec3(0, 0, 1) : normals_[at(c[2])]);
    part.normals_missing = part.normals_missing || c[2] < 0;
    return found->second;
  }

  static SourcePart finished(Part& part) {
    if (part.normals_missing) part.source.normals = computed_normals(part.source);
    part.source.branch_ids.assign(part.source.positions.size(), part.group);
    part.known = {};
    return std::move(part.source);
  }

  ObjMaterials materials_;
  std::vector<Vec3d> positions_;
  std::vector<Vec2> uvs_;
  std::vector<Vec3> normals_;
  std::string group_name_;
  int material_ = -1;
  std::map<std::string, std::size_t> groups_;
  std::map<std::pair<std::int32_t, int>, std::size_t> part_of_;
  std::vector<Part> parts_;
  Part* part_ = nullptr;
  std::size_t vertices_ = 0, indices_ = 0;
  std::vector<Corner> corners_;  // of a face
  std::vector<Vec3d> places_;
};

PlantReading read_bytes(std::span<const unsigned char> bytes, const std::string& name,
                        const std::optional<std::filesystem::path>& folder) {
  FolderFiles files(folder, kMaxObjBytes);
  ObjReader reader(files);
  reader.read({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  PlantReading reading = reader.finish(name);
  reading.files = files.names_read();
  return reading;
}

}  // namespace

PlantReading examine_obj(const std::filesystem::path& file) {
  try {
    const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    return read_bytes(files::read_whole(file, kMaxObjBytes), file.stem().string(), folder);
  } catch (const std::exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

PlantReading examine_obj(std::span<const unsigned char> bytes, const std::string& name) {
  try {
    return read_bytes(bytes, name, std::nullopt);
  } catch (const std::exception& error) {
    throw std::runtime_error(name + ": " + error.what());
  }
}

}  // namespace manzana::foliage

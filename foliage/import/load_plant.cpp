#include "foliage/import/load_plant.h"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "files/whole_file.h"
#include "foliage/generate.h"
#include "foliage/import/cache_file.h"
#include "foliage/import/folder_files.h"
#include "foliage/import/gltf_plant.h"
#include "foliage/import/json_members.h"
#include "foliage/import/obj_plant.h"
#include "foliage/import/plant_cache.h"
#include "foliage/import/species.h"
#include "foliage/import/turtle.h"

namespace manzana::foliage {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxJsonBytes = 4U << 20, kMaxSourceBytes = 256U << 20;

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error(what); }

std::string lower_extension(const fs::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

bool holds_lsystems(const Json& json) {
  return json.is_object() && std::any_of(json.begin(), json.end(), [](const Json& value) {
           return value.is_object() && (value.contains("axiom") || value.contains("rules"));
         });
}

const LSystem& chosen(const std::vector<LSystem>& systems, const std::string& name) {
  if (systems.size() == 1 && name.empty()) return systems[0];
  std::string names;
  for (const LSystem& system : systems) {
    if (system.name == name) return system;
    names += (names.empty() ? "" : ", ") + system.name;
  }
  fail((name.empty() ? "holds several L-systems: choose one of " : "has no L-system " + name + ", but ") + names);
}

Plant plant_from_json(const PlantSource& source) {
  const auto bytes = files::read_whole(source.file, kMaxJsonBytes);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (holds_lsystems(parse_json(text))) return grow_plant(chosen(parse_lsystems(text), source.system));
  if (!source.system.empty()) fail("holds no L-systems");
  return grow_plant(parse_species(text), source.seed);
}

std::string checksum(const std::vector<unsigned char>& bytes) {
  return std::to_string(XXH3_64bits(bytes.data(), bytes.size()));
}

std::vector<unsigned char> content_of(const fs::path& file) {
  try {
    return files::read_whole(file, kMaxSourceBytes);
  } catch (const std::exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

std::string description_of(const PrepareOptions& options) {
  const auto& [quads_per_cell, branch_levels, branch_order, visibility_side, seed, progress] = options;
  std::ostringstream text;
  text << "format " << kPlantFormat << " cells " << quads_per_cell << " levels " << branch_levels << " order "
       << static_cast<int>(branch_order) << " side " << visibility_side << " seed " << seed;
  return text.str();
}

/// Two files for a plant: KEY.files names what its source refers to; KEY2.plant, whose name depends on the content of
/// those as well, is the plant.
class Shelf {
 public:
  /// `description`: of all that the plant depends on, but the other files, which are in the folder `others`.
  Shelf(fs::path folder, std::string stem, fs::path others, std::string description)
      : folder_(std::move(folder)),
        stem_(std::move(stem)),
        others_(std::move(others)),
        description_(std::move(description)) {}

  std::optional<PreparedPlant> look(const TellLine& tell) const {
    try {
      const auto names = names_listed();
      if (!names) return std::nullopt;
      const fs::path file = plant_file(*names);
      if (!fs::exists(file)) return std::nullopt;
      return read_prepared(file);
    } catch (const std::exception& error) {
      tell(std::string(error.what()) + "; made again");
      return std::nullopt;
    }
  }

  void keep(const PreparedPlant& plant, const std::vector<std::string>& names, const TellLine& tell) const {
    try {
      std::string list;
      for (const std::string& name : names) list += name + '\n';
      files::make_folder(folder_);
      files::write_whole(list_file(), list);
      write_prepared(plant_file(names), plant);
    } catch (const std::exception& error) {
      tell(std::string(error.what()) + "; the plant is not kept");
    }
  }

 private:
  fs::path named(const std::string& description, const char* extension) const {
    return cache_path(folder_, stem_, description, extension);
  }

  fs::path list_file() const { return named(description_, ".files"); }

  /// Throws for a file that is absent now, or outside the folder.
  fs::path plant_file(const std::vector<std::string>& names) const {
    FolderFiles others(others_, kMaxSourceBytes);
    std::string description = description_;
    for (const std::string& name : names) {
      const auto bytes = others.read(name);
      description += " and " + name + " " + (bytes ? checksum(*bytes) : "absent");
    }
    return named(description, ".plant");
  }

  std::optional<std::vector<std::string>> names_listed() const {
    if (!fs::exists(list_file())) return std::nullopt;
    const auto bytes = files::read_whole(list_file(), 1U << 20);
    std::vector<std::string> names(1);
    for (const unsigned char c : bytes) {
      if (c == '\n')
        names.emplace_back();
      else
        names.back().push_back(static_cast<char>(c));
    }
    names.pop_back();
    return names;
  }

  fs::path folder_;
  std::string stem_;
  fs::path others_;
  std::string description_;
};

Shelf shelf_of(const fs::path& folder, const PlantSource& source, const PrepareOptions& options) {
  std::ostringstream text;
  text << description_of(options) << " of " << source.seed << ' ' << source.system << " name "
       << source.file.stem().string() << " content " << checksum(content_of(source.file));
  return {folder, source.file.stem().string(), folder_of(source.file), text.str()};
}

Shelf shelf_of(const fs::path& folder, std::string_view species, std::uint64_t seed, const PrepareOptions& options) {
  const std::string_view json = builtin_species_json(species);
  std::ostringstream text;
  text << description_of(options) << " species " << seed << " content " << XXH3_64bits(json.data(), json.size());
  return {folder, std::string(species), ".", text.str()};
}

}  // namespace

PlantSource parse_plant_source(const std::string& text) {
  const std::size_t at = text.rfind('#');
  std::error_code error;
  if (at == std::string::npos || fs::exists(text, error)) return {text};
  return {text.substr(0, at), text.substr(at + 1)};
}

PlantReading load_plant(const PlantSource& source) {
  const std::string extension = lower_extension(source.file);
  if (extension == ".glb" || extension == ".gltf") return examine_plant(source.file);
  if (extension == ".obj") return examine_obj(source.file);
  try {
    if (extension == ".json") return {plant_from_json(source), {}, {}, {}};
    fail("is no file of a kind that holds plants: .glb, .gltf, .obj, .json");
  } catch (const std::exception& error) {
    throw std::runtime_error(source.file.string() + ": " + error.what());
  }
}

std::optional<fs::path> default_cache_folder() {
  const auto absolute = [](const char* name) -> std::optional<fs::path> {
    const char* value = std::getenv(name);
    if (value == nullptr || *value != '/') return std::nullopt;
    return value;
  };
  if (const auto cache = absolute("XDG_CACHE_HOME")) return *cache / "manzana";
  if (const auto home = absolute("HOME")) return *home / ".cache" / "manzana";
  return std::nullopt;
}

PreparedPlant load_or_prepare(const PlantSource& source, const std::optional<fs::path>& cache_folder,
                              const PrepareOptions& options, const TellLine& tell) {
  std::optional<Shelf> shelf;
  if (cache_folder && fs::is_regular_file(source.file)) shelf.emplace(shelf_of(*cache_folder, source, options));
  if (shelf)
    if (auto kept = shelf->look(tell)) return std::move(*kept);
  const PlantReading reading = load_plant(source);
  for (const std::string& note : reading.notes) tell(source.file.string() + ": " + note);
  PreparedPlant plant = prepare(reading.plant, options);
  if (shelf) shelf->keep(plant, reading.files, tell);
  return plant;
}

PreparedPlant grow_or_prepare(std::string_view species, std::uint64_t seed, const std::optional<fs::path>& cache_folder,
                              const PrepareOptions& options, const TellLine& tell) {
  std::optional<Shelf> shelf;
  if (cache_folder) shelf.emplace(shelf_of(*cache_folder, species, seed, options));
  if (shelf)
    if (auto kept = shelf->look(tell)) return std::move(*kept);
  PreparedPlant plant = prepare(grow_plant(builtin_species(species), seed), options);
  if (shelf) shelf->keep(plant, {}, tell);
  return plant;
}

}  // namespace manzana::foliage

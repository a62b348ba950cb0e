#include "foliage/import/species.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "manzana_plant_import_presets.h"

namespace manzana::foliage {
namespace {

using Json = nlohmann::json;

[[noreturn]] void fail(const std::string& key, const std::string& what) {
  throw std::runtime_error("species: " + key + ": " + what);
}

void read(const Json& json, const std::string& key, float& out) {
  if (!json.is_number()) fail(key, "is not a number");
  const auto value = json.get<double>();
  if (!(std::abs(value) <= 1e9)) fail(key, "is out of range");
  out = static_cast<float>(value);
}

void read(const Json& json, const std::string& key, int& out) {
  if (!json.is_number_integer()) fail(key, "is not a whole number");
  const auto value = json.get<double>();  // no whole number wraps round
  if (!(std::abs(value) <= 1e6)) fail(key, "is out of range");
  out = static_cast<int>(value);
}

void read(const Json& json, const std::string& key, std::string& out) {
  if (!json.is_string()) fail(key, "is not a string");
  out = json.get<std::string>();
}

/// "#rrggbb"
void read(const Json& json, const std::string& key, std::uint32_t& out) {
  std::string text;
  read(json, key, text);
  if (text.size() != 7 || text[0] != '#' || text.find_first_not_of("0123456789abcdefABCDEF", 1) != std::string::npos)
    fail(key, "is not a colour like \"#4f7a35\"");
  out = static_cast<std::uint32_t>(std::stoul(text.substr(1), nullptr, 16));
}

/// An object's members, each asked for once; finish() refuses those that nobody asked for.
class Members {
 public:
  Members(const Json& json, std::string where) : json_(json), where_(std::move(where)) {
    if (!json.is_object()) fail(where_.empty() ? "the whole" : where_, "is not an object");
  }

  template <class T>
  Members& take(const char* name, T& out) {
    names_.emplace_back(name);
    if (const auto found = json_.find(name); found != json_.end()) read(*found, key(name), out);
    return *this;
  }

  const Json* array(const char* name) {
    names_.emplace_back(name);
    const auto found = json_.find(name);
    if (found == json_.end()) return nullptr;
    if (!found->is_array()) fail(key(name), "is not an array");
    return &*found;
  }

  void finish() const {
    for (const auto& item : json_.items())
      if (std::find(names_.begin(), names_.end(), item.key()) == names_.end()) fail(key(item.key()), "unknown key");
  }

 private:
  std::string key(const std::string& name) const { return where_.empty() ? name : where_ + "." + name; }

  const Json& json_;
  std::string where_;
  std::vector<std::string> names_;
};

void read_stem(const Json& json, const std::string& where, StemParams& stem) {
  Members members(json, where);
  members.take("down_angle", stem.down_angle).take("down_angle_v", stem.down_angle_v);
  members.take("rotate", stem.rotate).take("rotate_v", stem.rotate_v).take("branches", stem.branches);
  members.take("length", stem.length).take("length_v", stem.length_v).take("taper", stem.taper);
  members.take("curve_res", stem.curve_res).take("curve", stem.curve).take("curve_v", stem.curve_v);
  members.take("curve_back", stem.curve_back).take("seg_splits", stem.seg_splits);
  members.take("split_angle", stem.split_angle).take("split_angle_v", stem.split_angle_v);
  members.finish();
}

SpeciesParams read_species(const Json& json) {
  SpeciesParams species;
  Members members(json, "");
  members.take("name", species.name).take("shape", species.shape).take("scale", species.scale);
  members.take("scale_v", species.scale_v).take("base_size", species.base_size).take("ratio", species.ratio);
  members.take("ratio_power", species.ratio_power).take("flare", species.flare);
  members.take("base_splits", species.base_splits).take("levels", species.levels).take("leaves", species.leaves);
  members.take("leaf_scale", species.leaf_scale).take("leaf_scale_x", species.leaf_scale_x);
  members.take("attraction_up", species.attraction_up).take("leaf_shape", species.leaf_shape);
  members.take("leaf_rgb", species.leaf_rgb).take("bark_rgb", species.bark_rgb);
  if (const Json* stems = members.array("stems")) {
    if (stems->size() > species.stems.size()) fail("stems", "has more than 4 levels");
    for (std::size_t i = 0; i < stems->size(); ++i)
      read_stem((*stems)[i], "stems[" + std::to_string(i) + "]", species.stems[i]);
  }
  members.finish();
  return species;
}

}  // namespace

SpeciesParams parse_species(std::string_view json) {
  Json parsed;
  try {
    parsed = Json::parse(json);
  } catch (const Json::exception& error) {
    throw std::runtime_error(std::string("species: ") + error.what());
  }
  return read_species(parsed);
}

SpeciesParams builtin_species(std::string_view name) {
  if (name == "broadleaf") return parse_species(presets::broadleaf_json);
  if (name == "conifer") return parse_species(presets::conifer_json);
  assert(name == "shrub");
  return parse_species(presets::shrub_json);
}

}  // namespace manzana::foliage

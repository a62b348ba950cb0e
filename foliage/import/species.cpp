#include "foliage/import/species.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>

#include "foliage/import/json_members.h"
#include "manzana_plant_import_presets.h"

namespace manzana::foliage {
namespace {

constexpr std::array<std::string_view, kSpeciesNames.size()> kPresets{
    presets::broadleaf_json, presets::conifer_json, presets::shrub_json, presets::oak_json,
    presets::birch_json,     presets::poplar_json,  presets::pine_json,  presets::willow_json,
    presets::lime_json,      presets::palm_json,    presets::apple_json};  // as kSpeciesNames

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
  members.take("organ", species.organ).take("organs", species.organs).take("organ_scale", species.organ_scale);
  members.take("organ_rgb", species.organ_rgb);
  if (const Json* stems = members.array("stems")) {
    if (stems->size() > species.stems.size()) fail_at("stems", "has more than 4 levels");
    for (std::size_t i = 0; i < stems->size(); ++i)
      read_stem((*stems)[i], "stems[" + std::to_string(i) + "]", species.stems[i]);
  }
  members.finish();
  return species;
}

}  // namespace

SpeciesParams parse_species(std::string_view json) {
  try {
    return read_species(parse_json(json));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(std::string("species: ") + error.what());
  }
}

std::string_view builtin_species_json(std::string_view name) {
  const auto found = std::find(kSpeciesNames.begin(), kSpeciesNames.end(), name);
  assert(found != kSpeciesNames.end());
  return kPresets[static_cast<std::size_t>(found - kSpeciesNames.begin())];
}

SpeciesParams builtin_species(std::string_view name) { return parse_species(builtin_species_json(name)); }

}  // namespace manzana::foliage

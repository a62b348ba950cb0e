#pragma once
/// A parametric tree after Weber and Penn, Creation and Rendering of Realistic Trees, SIGGRAPH 1995. Names of
/// parameters are the paper's. Presets: data/species/*.json, read by foliage/import/species.h.
#include <array>

#include "foliage/plant.h"

namespace manzana::foliage {

/// One level of branching (0: trunk). Angles in degrees, V: the variation about a value.
struct StemParams {
  float down_angle = 0, down_angle_v = 0, rotate = 0, rotate_v = 0;
  int branches = 0;                ///< on a parent of this level's length
  float length = 1, length_v = 0;  ///< fraction of the parent's (level 0: of the scale)
  float taper = 1;
  int curve_res = 4;  ///< segments
  float curve = 0, curve_v = 0, curve_back = 0;
  float seg_splits = 0, split_angle = 0, split_angle_v = 0;
};

struct SpeciesParams {
  std::string name;
  int shape = 0;                  ///< crown envelope, 0 conical ... 7 tend flame, as in the paper
  float scale = 10, scale_v = 0;  ///< height, metres
  float base_size = 0.2F;         ///< fraction of the trunk without branches
  float ratio = 0.015F, ratio_power = 1.2F, flare = 0.5F;
  int base_splits = 0;
  int levels = 3;
  std::array<StemParams, 4> stems{};
  int leaves = 20;                               ///< cards on a stem of the last level
  float leaf_scale = 0.5F, leaf_scale_x = 0.8F;  ///< length of a card in metres, width over length
  float attraction_up = 0;
  std::string leaf_shape = "oval";  ///< what the leaf image shows: leaf_image.h lists them
  std::uint32_t leaf_rgb = 0x4f7a35, bark_rgb = 0x6b5a48;
  std::string organ = "none";  ///< none, flower, fruit
  int organs = 0;              ///< on a stem of the last level, on average
  float organ_scale = 0.1F;    ///< metres across
  std::uint32_t organ_rgb = 0xb03030;
};

/// A branch for each stem, a terminal for each leaf card, flower and fruit, leaves first; shaded, and normals bent
/// outward. A few thousand triangles; the same for a seed on every machine (counter hash). Throws std::invalid_argument
/// for parameters that are not finite or out of range (negative curve_v, the paper's helix, among them), or would make
/// more than 1 000 000 vertices. Cost: about 0.1 s, most of it the two images.
Plant grow_plant(const SpeciesParams& species, std::uint64_t seed);

}  // namespace manzana::foliage

#pragma once
/// A house of CityJSON whose southern wall wears a picture of four colours, and a camera before it.
#include <fstream>

#include "apps/common/png.h"
#include "tests/import/cityjson/made.h"
#include "tests/view/host.h"

namespace manzana::worn_house {

using made::Json;

inline constexpr int kWidth = 360, kHeight = 160;

/// Lower left red, lower right green, upper left blue, upper right white.
inline void write_quarters(const std::filesystem::path& file) {
  constexpr int kSide = 64;
  std::vector<unsigned char> rgb;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const bool right = x >= kSide / 2, lower = y >= kSide / 2;
      const auto byte = [](bool lit) { return static_cast<unsigned char>(lit ? 240 : 10); };
      rgb.insert(rgb.end(), {byte(lower != right), byte(right), byte(!lower)});
    }
  apps::write_png(file, kSide, kSide, rgb);
}

/// A house of 24 x 8 x 8 m whose southern wall wears the picture from `low` to `high`.
inline Json house(const std::string& wrap, const Vec2d& low, const Vec2d& high) {
  Json json = made::city();
  json.erase("metadata");
  json["vertices"] = made::box_vertices({100, 200, 5}, {124, 208, 13});
  json["CityObjects"]["house"] = {{"type", "Building"}, {"geometry", {made::solid()}}};
  json["appearance"] = {
      {"textures", {{{"type", "PNG"}, {"image", "quarters.png"}, {"wrapMode", wrap}, {"borderColor", {1, 1, 0, 1}}}}},
      {"vertices-texture", {{low.x, low.y}, {high.x, low.y}, {high.x, high.y}, {low.x, high.y}}}};
  const Json nothing = Json::array({Json::array({nullptr})}), wall = Json::array({Json({0, 0, 1, 2, 3})});
  json["CityObjects"]["house"]["geometry"][0]["texture"] = {
      {"seen", {{"values", Json::array({Json::array({nothing, nothing, wall, nothing, nothing, nothing})})}}}};
  return json;
}

inline std::filesystem::path written(const std::filesystem::path& folder, const Json& json) {
  const auto file = folder / "house.city.json";
  std::ofstream(file) << json;
  return file;
}

/// From the south.
inline HostCamera before_wall(const Scene& scene) {
  const Vec3d middle = (scene.bounds.min + scene.bounds.max) / 2.0;
  return looking({middle.x, scene.bounds.min.y - 22, middle.z}, middle, kWidth, kHeight);
}

}  // namespace manzana::worn_house

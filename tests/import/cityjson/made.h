#pragma once
/// CityJSON made by tests.
#include <nlohmann/json.hpp>
#include <string>

#include "scenegraph/import/cityjson.h"

namespace made {
using Json = nlohmann::json;

/// A box from `low` to `high` as a Solid, outward; vertices from `first` on.
inline Json box_vertices(const std::array<double, 3>& low, const std::array<double, 3>& high) {
  Json vertices = Json::array();
  for (int i = 0; i < 8; ++i)
    vertices.push_back(
        {(i & 1) != 0 ? high[0] : low[0], (i & 2) != 0 ? high[1] : low[1], (i & 4) != 0 ? high[2] : low[2]});
  return vertices;
}
inline Json box_shell(int first) {
  Json shell = Json::array();
  for (const auto& face :
       {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}}) {
    Json ring = Json::array();
    for (const int corner : face) ring.push_back(first + corner);
    shell.push_back(Json::array({ring}));
  }
  return shell;
}
inline Json solid(int first = 0) { return {{"type", "Solid"}, {"lod", "2"}, {"boundaries", {box_shell(first)}}}; }

inline Json city() {
  return {{"type", "CityJSON"},
          {"version", "2.0"},
          {"metadata", {{"referenceSystem", "https://www.opengis.net/def/crs/EPSG/0/25832"}}},
          {"CityObjects", Json::object()},
          {"vertices", Json::array()}};
}
/// A building 10 x 8 x 6 m whose floor is at 412 m, near Munich.
inline Json one_building() {
  Json json = city();
  json["vertices"] = box_vertices({691000, 5334000, 412}, {691010, 5334008, 418});
  json["CityObjects"]["house"] = {{"type", "Building"}, {"geometry", {solid()}}};
  return json;
}

inline manzana::CityFeatures read(const Json& json, const manzana::ImportOptions& options = {}) {
  return manzana::read_cityjson_bytes(json.dump(), false, options, {});
}

inline bool listed(const manzana::CityFeatures& city, const std::string& where, const std::string& what) {
  for (const manzana::Issue& issue : city.issues)
    if (issue.where.find(where) != std::string::npos && issue.what.find(what) != std::string::npos) return true;
  return false;
}

}  // namespace made

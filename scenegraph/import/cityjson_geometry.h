#pragma once
/// The geometry of CityJSON: nested arrays of vertex numbers become flat surfaces.  [CityJSON 2.0, section 3]
///   const Surfaces s = surfaces_of(geometry, vertices.size());   // throws std::runtime_error: what is wrong
/// Nothing is believed: types, depths and numbers are checked before they are used.
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "culling/vec.h"

namespace manzana::cityjson {

using Json = nlohmann::json;

inline constexpr std::uint32_t kNone = UINT32_MAX;

/// Runs, as in ConstructionFeature; corners are vertex numbers below the count that was given.
struct Surfaces {
  struct Face {
    std::uint32_t last_ring = 0;
    std::uint32_t semantic = kNone;  ///< of geometry.semantics.surfaces
  };
  std::vector<std::uint32_t> corners, ring_last;
  std::vector<std::uint32_t> number;  ///< a row a corner: which of its ring it is in the file, from 0
  std::vector<Face> faces;
  std::vector<std::uint32_t> part_last;  ///< a solid, or all of a set of surfaces
};

/// MultiSurface, CompositeSurface, Solid (its outer shell: what is seen), MultiSolid, CompositeSolid; of others, as of
/// points and lines, nothing. Rings lose points that repeat.
Surfaces surfaces_of(const Json& geometry, std::size_t vertices);

/// What `values`, nested as the boundaries are, say of each face of surfaces_of; null: nothing.
std::vector<const Json*> value_of_each(const Json& geometry, const Json* values);
/// A number of something, kNone where it is none.
std::uint32_t number_of(const Json* value);

/// Of a MultiPoint.
std::vector<std::uint32_t> points_of(const Json& geometry, std::size_t vertices);

/// GeometryInstance: a template, where it stands, and the matrix before that, by rows.
struct Instance {
  std::uint32_t geometry = 0, vertex = 0;
  std::array<double, 16> matrix{};
  Vec3d operator()(const Vec3d& p) const;
};
Instance instance_of(const Json& geometry, std::size_t templates, std::size_t vertices);

/// A member of an object, or null: also where `json` is no object.
const Json* member(const Json& json, const char* name);
/// A string, or the first of an array of strings; else empty.
std::string text_of(const Json* json);
/// 2 for "2", 2.2 for "2.2" or 2.2; 0 without one.
double lod_of(const Json& geometry);
/// Three finite numbers. Throws.
Vec3d vec3_of(const Json& json, const char* what);

}  // namespace manzana::cityjson

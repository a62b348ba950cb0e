#include "scenegraph/import/cityjson_geometry.h"

#include <charconv>
#include <cmath>
#include <stdexcept>

namespace manzana::cityjson {
namespace {

const Json& array_in(const Json* json, const char* what) {
  if (json == nullptr || !json->is_array()) throw std::runtime_error(std::string(what) + " is not an array");
  return *json;
}

std::uint32_t number_below(const Json& json, std::size_t count, const char* what) {
  if (!json.is_number_integer()) throw std::runtime_error(std::string(what) + " is not a whole number");
  const double value = json.get<double>();
  if (value < 0 || value >= static_cast<double>(count))
    throw std::runtime_error(std::string(what) + " " + json.dump() + ", and there are " + std::to_string(count));
  return json.get<std::uint32_t>();
}

/// Values lie beside the boundaries, nested alike; what is null or absent says nothing.
const Json* beside(const Json* values, std::size_t i) {
  return values != nullptr && values->is_array() && i < values->size() ? &(*values)[i] : nullptr;
}

/// visit(shell, what is beside it) for those that are seen: of a solid the outer one.
template <class Visit>
void each_shell(const Json& geometry, const Json* values, Visit&& visit) {
  const std::string type = text_of(member(geometry, "type"));
  const auto boundaries = [&]() -> const Json& { return array_in(member(geometry, "boundaries"), "boundaries"); };
  const auto solid = [&](const Json& shells, const Json* those) {
    if (!array_in(&shells, "a solid").empty()) visit(shells[0], beside(those, 0));
  };
  if (type == "MultiSurface" || type == "CompositeSurface") visit(boundaries(), values);
  if (type == "Solid") solid(boundaries(), values);
  if (type == "MultiSolid" || type == "CompositeSolid")
    for (std::size_t i = 0; i < boundaries().size(); ++i) solid(boundaries()[i], beside(values, i));
}

class Decoder {
 public:
  explicit Decoder(std::size_t vertices) : vertices_(vertices) {}

  void part(const Json& faces, const Json* semantics) {
    for (std::size_t i = 0; i < array_in(&faces, "a shell").size(); ++i) {
      for (const Json& r : array_in(&faces[i], "a surface")) ring(r);
      out_.faces.push_back({static_cast<std::uint32_t>(out_.ring_last.size()), number_of(beside(semantics, i))});
    }
    out_.part_last.push_back(static_cast<std::uint32_t>(out_.faces.size()));
  }

  Surfaces take() { return std::move(out_); }

 private:
  void ring(const Json& json) {
    const std::size_t first = out_.corners.size();
    std::uint32_t number = 0;
    for (const Json& corner : array_in(&json, "a ring")) {
      const std::uint32_t v = number_below(corner, vertices_, "a boundary refers to vertex");
      if (out_.corners.size() == first || out_.corners.back() != v)
        out_.corners.push_back(v), out_.number.push_back(number);
      ++number;
    }
    while (out_.corners.size() > first + 1 && out_.corners.back() == out_.corners[first])
      out_.corners.pop_back(), out_.number.pop_back();
    out_.ring_last.push_back(static_cast<std::uint32_t>(out_.corners.size()));
  }

  std::size_t vertices_;
  Surfaces out_;
};

}  // namespace

Surfaces surfaces_of(const Json& geometry, std::size_t vertices) {
  Decoder decoder(vertices);
  const Json* semantics = member(geometry, "semantics");
  each_shell(geometry, semantics == nullptr ? nullptr : member(*semantics, "values"),
             [&](const Json& shell, const Json* kinds) { decoder.part(shell, kinds); });
  return decoder.take();
}

std::vector<const Json*> value_of_each(const Json& geometry, const Json* values) {
  std::vector<const Json*> each;
  each_shell(geometry, values, [&](const Json& shell, const Json* those) {
    for (std::size_t i = 0; i < shell.size(); ++i) each.push_back(beside(those, i));
  });
  return each;
}

std::uint32_t number_of(const Json* value) {
  const bool plain = value != nullptr && value->is_number_unsigned() && value->get<std::uint64_t>() < kNone;
  return plain ? value->get<std::uint32_t>() : kNone;
}

std::vector<std::uint32_t> points_of(const Json& geometry, std::size_t vertices) {
  std::vector<std::uint32_t> points;
  if (text_of(member(geometry, "type")) != "MultiPoint") return points;
  for (const Json& v : array_in(member(geometry, "boundaries"), "boundaries"))
    points.push_back(number_below(v, vertices, "a boundary refers to vertex"));
  return points;
}

Vec3d Instance::operator()(const Vec3d& p) const {
  const auto row = [&](std::size_t r) {
    return matrix[r] * p.x + matrix[r + 1] * p.y + matrix[r + 2] * p.z + matrix[r + 3];
  };
  return {row(0), row(4), row(8)};
}

Instance instance_of(const Json& geometry, std::size_t templates, std::size_t vertices) {
  Instance result;
  const Json* number = member(geometry, "template");
  if (number == nullptr) throw std::runtime_error("an instance without a template");
  result.geometry = number_below(*number, templates, "an instance refers to template");
  const Json& boundaries = array_in(member(geometry, "boundaries"), "boundaries");
  if (boundaries.size() != 1) throw std::runtime_error("an instance stands at one vertex, not at another number");
  result.vertex = number_below(boundaries[0], vertices, "a boundary refers to vertex");
  const Json& matrix = array_in(member(geometry, "transformationMatrix"), "transformationMatrix");
  if (matrix.size() != 16) throw std::runtime_error("transformationMatrix is not of 16 numbers");
  for (std::size_t i = 0; i < 16; ++i) {
    if (!matrix[i].is_number()) throw std::runtime_error("transformationMatrix is not of 16 numbers");
    result.matrix[i] = matrix[i].get<double>();
  }
  return result;
}

const Json* member(const Json& json, const char* name) {
  if (!json.is_object()) return nullptr;
  const auto found = json.find(name);
  return found == json.end() ? nullptr : &*found;
}

std::string text_of(const Json* json) {
  if (json != nullptr && json->is_array() && !json->empty()) json = &json->front();
  return json != nullptr && json->is_string() ? json->get<std::string>() : std::string();
}

double lod_of(const Json& geometry) {
  const Json* lod = member(geometry, "lod");
  if (lod == nullptr) return 0;
  if (lod->is_number()) return lod->get<double>();
  const std::string text = text_of(lod);
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return std::isfinite(value) ? value : 0;
}

Vec3d vec3_of(const Json& json, const char* what) {
  const bool three =
      json.is_array() && json.size() == 3 && json[0].is_number() && json[1].is_number() && json[2].is_number();
  if (!three) throw std::runtime_error(std::string(what) + " is not of three numbers");
  const Vec3d v(json[0].get<double>(), json[1].get<double>(), json[2].get<double>());
  if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
    throw std::runtime_error(std::string(what) + " is not finite");
  return v;
}

}  // namespace manzana::cityjson

#pragma once
/// Reading JSON that people write: every key is known, every value of its type, and what is wrong is named by its
/// place.
///   Members members(json, "stems[0]");
///   members.take("curve", stem.curve).take("taper", stem.taper);   // what is absent stays as it is
///   members.finish();                                              // "stems[0].curv: unknown key"
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace manzana::foliage {

using Json = nlohmann::json;

/// Throws std::runtime_error in one line.
Json parse_json(std::string_view text);

[[noreturn]] void fail_at(const std::string& place, const std::string& what);  ///< std::runtime_error "place: what"

/// Each throws for another type, and for what is out of range: numbers beyond 1e9, whole ones beyond 1e6.
void read_value(const Json& json, const std::string& place, float& out);
void read_value(const Json& json, const std::string& place, double& out);
void read_value(const Json& json, const std::string& place, int& out);
void read_value(const Json& json, const std::string& place, std::string& out);
void read_value(const Json& json, const std::string& place, std::uint32_t& out);  ///< a colour: "#rrggbb"

/// An object's members, each asked for once; finish() refuses those that nobody asked for.
class Members {
 public:
  Members(const Json& json, std::string place);

  template <class T>
  Members& take(const char* name, T& out) {
    if (const Json* found = find(name)) read_value(*found, key(name), out);
    return *this;
  }

  template <class T>
  Members& need(const char* name, T& out) {
    if (!find(name)) fail_at(key(name), "is missing");
    return take(name, out);
  }

  const Json* find(const char* name);   ///< of any type, or nothing
  const Json* array(const char* name);  ///< or nothing
  std::string key(const std::string& name) const { return place_.empty() ? name : place_ + "." + name; }
  void finish() const;

 private:
  const Json& json_;
  std::string place_;
  std::vector<std::string> names_;
};

}  // namespace manzana::foliage

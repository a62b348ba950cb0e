// JSON of camera paths; see camera_path.h.
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "apps/walkthrough/camera_path.h"

namespace manzana::walkthrough {
namespace {

using Json = nlohmann::json;
constexpr double kFarthest = 1e6;  // metres from the anchor: as far as the frame is exact

[[noreturn]] void fail(const std::string& where, const std::string& what) {
  throw std::runtime_error(where + ": " + what);
}

const Json& member(const Json& object, const char* name, const std::string& where) {
  if (!object.is_object()) fail(where, "an object is needed");
  const auto found = object.find(name);
  if (found == object.end()) fail(where, std::string("\"") + name + "\" is missing");
  return *found;
}

double number(const Json& value, const std::string& where) {
  if (!value.is_number()) fail(where, "a number is needed");
  const double v = value.get<double>();
  if (!(std::abs(v) <= kFarthest)) fail(where, "a number within 1000000 is needed");
  return v;
}

Vec3d point(const Json& key, const char* name, const std::string& key_where) {
  const Json& value = member(key, name, key_where);
  const std::string where = key_where + "." + name;
  if (!value.is_array() || value.size() != 3) fail(where, "three numbers are needed");
  return {number(value[0], where + "[0]"), number(value[1], where + "[1]"), number(value[2], where + "[2]")};
}

CameraKey parse_key(const Json& key, const std::string& where) {
  const CameraKey parsed{number(member(key, "t", where), where + ".t"),
                         {point(key, "eye", where), point(key, "look", where)}};
  if (glm::distance(parsed.pose.eye, parsed.pose.look) < 1e-3) fail(where, "eye and look are the same point");
  return parsed;
}

CameraPath path_of(const Json& json, const std::string& where) {
  CameraPath path;
  const Json& keys = member(json, "keys", where);
  if (json.contains("name") && json["name"].is_string()) path.name = json["name"].get<std::string>();
  if (!keys.is_array() || keys.empty()) fail(where + ": keys", "at least one key is needed");
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const std::string key_where = where + ": keys[" + std::to_string(i) + "]";
    path.keys.push_back(parse_key(keys[i], key_where));
    if (i > 0 && !(path.keys[i].t > path.keys[i - 1].t)) fail(key_where + ".t", "must be later than the key before");
  }
  return path;
}

/// "[json.exception.parse_error.101] parse error at line 1, column 2: ..." without the bracket.
std::string message_of(const Json::exception& error) {
  const std::string text = error.what();
  const std::size_t end = text.find("] ");
  return end == std::string::npos ? text : text.substr(end + 2);
}

Json to_array(const Vec3d& p) { return {p.x, p.y, p.z}; }

}  // namespace

CameraPath parse_path(std::string_view json, const std::string& where) {
  try {
    return path_of(Json::parse(json), where);
  } catch (const Json::exception& error) {
    fail(where, message_of(error));
  }
}

CameraPath read_path(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) fail(file.string(), "is a folder, not a camera path");
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) fail(file.string(), "no such camera path: tour, pina or a JSON file that can be read");
  return parse_path(text.str(), file.string());
}

std::string to_json(const CameraPath& path) {
  Json keys = Json::array();
  for (const CameraKey& key : path.keys)
    keys.push_back({{"t", key.t}, {"eye", to_array(key.pose.eye)}, {"look", to_array(key.pose.look)}});
  return Json{{"name", path.name}, {"keys", keys}}.dump(1) + "\n";
}

}  // namespace manzana::walkthrough

#include "foliage/import/json_members.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace manzana::foliage {

Json parse_json(std::string_view text) {
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    throw std::runtime_error(error.what());
  }
}

void fail_at(const std::string& place, const std::string& what) { throw std::runtime_error(place + ": " + what); }

void read_value(const Json& json, const std::string& place, double& out) {
  if (!json.is_number()) fail_at(place, "is not a number");
  const auto value = json.get<double>();
  if (!(std::abs(value) <= 1e9)) fail_at(place, "is out of range");
  out = value;
}

void read_value(const Json& json, const std::string& place, float& out) {
  double value = 0;
  read_value(json, place, value);
  out = static_cast<float>(value);
}

void read_value(const Json& json, const std::string& place, int& out) {
  if (!json.is_number_integer()) fail_at(place, "is not a whole number");
  const auto value = json.get<double>();  // no whole number wraps round
  if (!(std::abs(value) <= 1e6)) fail_at(place, "is out of range");
  out = static_cast<int>(value);
}

void read_value(const Json& json, const std::string& place, std::string& out) {
  if (!json.is_string()) fail_at(place, "is not a string");
  out = json.get<std::string>();
}

void read_value(const Json& json, const std::string& place, std::uint32_t& out) {
  std::string text;
  read_value(json, place, text);
  if (text.size() != 7 || text[0] != '#' || text.find_first_not_of("0123456789abcdefABCDEF", 1) != std::string::npos)
    fail_at(place, "is not a colour like \"#4f7a35\"");
  out = static_cast<std::uint32_t>(std::stoul(text.substr(1), nullptr, 16));
}

Members::Members(const Json& json, std::string place) : json_(json), place_(std::move(place)) {
  if (!json.is_object()) fail_at(place_.empty() ? "the whole" : place_, "is not an object");
}

const Json* Members::find(const char* name) {
  names_.emplace_back(name);
  const auto found = json_.find(name);
  return found == json_.end() ? nullptr : &*found;
}

const Json* Members::array(const char* name) {
  const Json* found = find(name);
  if (found != nullptr && !found->is_array()) fail_at(key(name), "is not an array");
  return found;
}

void Members::finish() const {
  for (const auto& item : json_.items())
    if (std::find(names_.begin(), names_.end(), item.key()) == names_.end()) fail_at(key(item.key()), "unknown key");
}

}  // namespace manzana::foliage

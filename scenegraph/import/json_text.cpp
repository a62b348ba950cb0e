#include "scenegraph/import/json_text.h"

#include <algorithm>
#include <stdexcept>

namespace manzana {
namespace {

constexpr int kDeepest = 64;  // CityJSON has about 12

int depth_of(std::string_view text) {
  int depth = 0, deepest = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '\\')
      ++i;
    else if (c == '"')
      quoted = !quoted;
    else if (!quoted && (c == '[' || c == '{'))
      deepest = std::max(deepest, ++depth);
    else if (!quoted && (c == ']' || c == '}'))
      --depth;
  }
  return deepest;
}

/// "[json.exception.parse_error.101] parse error at line 1, column 9: syntax error ..." from "line" to the first ';'.
std::string place_in(std::string what) {
  const std::size_t at = what.find(" at line ");
  if (at != std::string::npos) what = what.substr(at + 4);
  return "no JSON: " + what.substr(0, 120);
}

}  // namespace

nlohmann::json parse_shallow_json(std::string_view text) {
  if (depth_of(text) > kDeepest) throw std::runtime_error("brackets nested deeper than " + std::to_string(kDeepest));
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(place_in(error.what()));
  }
}

}  // namespace manzana

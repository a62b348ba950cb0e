#pragma once
/// JSON that strangers wrote.
#include <nlohmann/json.hpp>
#include <string_view>

namespace manzana {

/// Refuses what is nested deeper than 64, before anything recursive sees it. Throws std::runtime_error in one line
/// ("no JSON: line 1, column 9: ...").
nlohmann::json parse_shallow_json(std::string_view text);

}  // namespace manzana

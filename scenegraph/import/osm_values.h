#pragma once
/// The values of OpenStreetMap's tags: free text, as people typed it.
///   parse_length("40'6\"")   // 12.34 m
///   parse_colour("#8a2")     // 0x88aa22
/// No answer where the text says nothing certain: lists ("12;15"), words ("tall"), numbers that are not finite.
#include <cstdint>
#include <optional>
#include <string_view>

namespace manzana {

/// Without the white space round it.
std::string_view trimmed(std::string_view text);

/// A number alone, with a point or a comma before its decimals.
std::optional<double> parse_number(std::string_view text);

/// Metres. Units: none or m, km, cm, mm, mi, ft, in, ' and " in any mixture ("40 ft", "5' 6\"").
std::optional<double> parse_length(std::string_view text);

/// 0xRRGGBB from #rgb, #rrggbb or a name of CSS Color Module Level 4, in any case; "_", "-" and spaces in names are
/// passed over.
std::optional<std::uint32_t> parse_colour(std::string_view text);

/// The usual colour of a building material ("brick", "plaster"), as building:material and roof:material have them.
std::optional<std::uint32_t> material_colour(std::string_view material);

/// "yes", "true", "1", and anything else that is not a form of no. Tags as bridge=viaduct say yes, too.
bool says_yes(const char* value);

}  // namespace manzana

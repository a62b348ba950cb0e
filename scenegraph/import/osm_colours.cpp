#include <algorithm>
#include <array>
#include <string>

#include "scenegraph/import/osm_values.h"

namespace manzana {
namespace {

struct Named {
  std::string_view name;
  std::uint32_t rgb;
};

// clang-format off
// Named colours of CSS Color Module Level 4, section 6.1, by name.
constexpr std::array<Named, 148> kColours{{
    {"aliceblue", 0xf0f8ff}, {"antiquewhite", 0xfaebd7}, {"aqua", 0x00ffff}, {"aquamarine", 0x7fffd4}, {"azure",
    0xf0ffff}, {"beige", 0xf5f5dc}, {"bisque", 0xffe4c4}, {"black", 0x000000}, {"blanchedalmond", 0xffebcd},
    {"blue", 0x0000ff}, {"blueviolet", 0x8a2be2}, {"brown", 0xa52a2a}, {"burlywood", 0xdeb887}, {"cadetblue",
    0x5f9ea0}, {"chartreuse", 0x7fff00}, {"chocolate", 0xd2691e}, {"coral", 0xff7f50}, {"cornflowerblue", 0x6495ed},
    {"cornsilk", 0xfff8dc}, {"crimson", 0xdc143c}, {"cyan", 0x00ffff}, {"darkblue", 0x00008b}, {"darkcyan",
    0x008b8b}, {"darkgoldenrod", 0xb8860b}, {"darkgray", 0xa9a9a9}, {"darkgreen", 0x006400}, {"darkgrey", 0xa9a9a9},
    {"darkkhaki", 0xbdb76b}, {"darkmagenta", 0x8b008b}, {"darkolivegreen", 0x556b2f}, {"darkorange", 0xff8c00},
    {"darkorchid", 0x9932cc}, {"darkred", 0x8b0000}, {"darksalmon", 0xe9967a}, {"darkseagreen", 0x8fbc8f},
    {"darkslateblue", 0x483d8b}, {"darkslategray", 0x2f4f4f}, {"darkslategrey", 0x2f4f4f}, {"darkturquoise",
    0x00ced1}, {"darkviolet", 0x9400d3}, {"deeppink", 0xff1493}, {"deepskyblue", 0x00bfff}, {"dimgray", 0x696969},
    {"dimgrey", 0x696969}, {"dodgerblue", 0x1e90ff}, {"firebrick", 0xb22222}, {"floralwhite", 0xfffaf0},
    {"forestgreen", 0x228b22}, {"fuchsia", 0xff00ff}, {"gainsboro", 0xdcdcdc}, {"ghostwhite", 0xf8f8ff}, {"gold",
    0xffd700}, {"goldenrod", 0xdaa520}, {"gray", 0x808080}, {"green", 0x008000}, {"greenyellow", 0xadff2f}, {"grey",
    0x808080}, {"honeydew", 0xf0fff0}, {"hotpink", 0xff69b4}, {"indianred", 0xcd5c5c}, {"indigo", 0x4b0082},
    {"ivory", 0xfffff0}, {"khaki", 0xf0e68c}, {"lavender", 0xe6e6fa}, {"lavenderblush", 0xfff0f5}, {"lawngreen",
    0x7cfc00}, {"lemonchiffon", 0xfffacd}, {"lightblue", 0xadd8e6}, {"lightcoral", 0xf08080}, {"lightcyan",
    0xe0ffff}, {"lightgoldenrodyellow", 0xfafad2}, {"lightgray", 0xd3d3d3}, {"lightgreen", 0x90ee90}, {"lightgrey",
    0xd3d3d3}, {"lightpink", 0xffb6c1}, {"lightsalmon", 0xffa07a}, {"lightseagreen", 0x20b2aa}, {"lightskyblue",
    0x87cefa}, {"lightslategray", 0x778899}, {"lightslategrey", 0x778899}, {"lightsteelblue", 0xb0c4de},
    {"lightyellow", 0xffffe0}, {"lime", 0x00ff00}, {"limegreen", 0x32cd32}, {"linen", 0xfaf0e6}, {"magenta",
    0xff00ff}, {"maroon", 0x800000}, {"mediumaquamarine", 0x66cdaa}, {"mediumblue", 0x0000cd}, {"mediumorchid",
    0xba55d3}, {"mediumpurple", 0x9370db}, {"mediumseagreen", 0x3cb371}, {"mediumslateblue", 0x7b68ee},
    {"mediumspringgreen", 0x00fa9a}, {"mediumturquoise", 0x48d1cc}, {"mediumvioletred", 0xc71585}, {"midnightblue",
    0x191970}, {"mintcream", 0xf5fffa}, {"mistyrose", 0xffe4e1}, {"moccasin", 0xffe4b5}, {"navajowhite", 0xffdead},
    {"navy", 0x000080}, {"oldlace", 0xfdf5e6}, {"olive", 0x808000}, {"olivedrab", 0x6b8e23}, {"orange", 0xffa500},
    {"orangered", 0xff4500}, {"orchid", 0xda70d6}, {"palegoldenrod", 0xeee8aa}, {"palegreen", 0x98fb98},
    {"paleturquoise", 0xafeeee}, {"palevioletred", 0xdb7093}, {"papayawhip", 0xffefd5}, {"peachpuff", 0xffdab9},
    {"peru", 0xcd853f}, {"pink", 0xffc0cb}, {"plum", 0xdda0dd}, {"powderblue", 0xb0e0e6}, {"purple", 0x800080},
    {"rebeccapurple", 0x663399}, {"red", 0xff0000}, {"rosybrown", 0xbc8f8f}, {"royalblue", 0x4169e1},
    {"saddlebrown", 0x8b4513}, {"salmon", 0xfa8072}, {"sandybrown", 0xf4a460}, {"seagreen", 0x2e8b57}, {"seashell",
    0xfff5ee}, {"sienna", 0xa0522d}, {"silver", 0xc0c0c0}, {"skyblue", 0x87ceeb}, {"slateblue", 0x6a5acd},
    {"slategray", 0x708090}, {"slategrey", 0x708090}, {"snow", 0xfffafa}, {"springgreen", 0x00ff7f}, {"steelblue",
    0x4682b4}, {"tan", 0xd2b48c}, {"teal", 0x008080}, {"thistle", 0xd8bfd8}, {"tomato", 0xff6347}, {"turquoise",
    0x40e0d0}, {"violet", 0xee82ee}, {"wheat", 0xf5deb3}, {"white", 0xffffff}, {"whitesmoke", 0xf5f5f5}, {"yellow",
    0xffff00}, {"yellowgreen", 0x9acd32}}};

// Materials as they are tagged, by name; the colours are ours.
constexpr std::array<Named, 44> kMaterials{{
    {"adobe", 0xc49a6c}, {"aluminium", 0xb0b5b8}, {"asbestos", 0x90908c}, {"asphalt", 0x56534f}, {"bitumen",
    0x4f4d4b}, {"brick", 0x9a5b43}, {"bricks", 0x9a5b43}, {"cement_block", 0xb0aca4}, {"clay", 0xb56a4a},
    {"concrete", 0xb4b0a8}, {"copper", 0x5f9f86}, {"eternit", 0x8c8c88}, {"glass", 0x8fa9b8}, {"granite", 0x9c9690},
    {"grass", 0x7d9a55}, {"gravel", 0x9a958c}, {"lead", 0x7c8286}, {"limestone", 0xcfc3a4}, {"marble", 0xdedad2},
    {"metal", 0x9aa0a4}, {"metal_plates", 0x9aa0a4}, {"mirror", 0x9ab4c4}, {"mud", 0xb48a5c}, {"plaster", 0xded4c0},
    {"plastic", 0xc8ccd0}, {"reinforced_concrete", 0xb4b0a8}, {"render", 0xdcd2be}, {"roof_tiles", 0xa5543a},
    {"sandstone", 0xc8a877}, {"slate", 0x555b63}, {"solar_panels", 0x2e3a52}, {"steel", 0x9aa0a4}, {"stone",
    0xb5a88f}, {"stucco", 0xded4c0}, {"tar_paper", 0x4f4d4b}, {"thatch", 0xa08a5c}, {"tile", 0xa5543a}, {"tiles",
    0xa5543a}, {"timber", 0x9a7450}, {"timber_framing", 0xd8cbb0}, {"tin", 0xa0a4a6}, {"vinyl", 0xd4d0c8}, {"wood",
    0x9a7450}, {"zinc", 0x8f979c}}};
// clang-format on

template <std::size_t n>
std::optional<std::uint32_t> find_named(const std::array<Named, n>& table, std::string_view name) {
  const auto at = std::ranges::lower_bound(table, name, {}, &Named::name);
  return at != table.end() && at->name == name ? std::optional(at->rgb) : std::nullopt;
}

std::optional<std::uint32_t> hex_digit(char c) {
  if (c >= '0' && c <= '9') return static_cast<std::uint32_t>(c - '0');
  if (c >= 'a' && c <= 'f') return static_cast<std::uint32_t>(c - 'a' + 10);
  return std::nullopt;
}

/// "8a2" or "88aa22".
std::optional<std::uint32_t> parse_hex(std::string_view digits) {
  if (digits.size() != 3 && digits.size() != 6) return std::nullopt;
  std::uint32_t rgb = 0;
  for (const char c : digits) {
    const auto digit = hex_digit(c);
    if (!digit) return std::nullopt;
    rgb = digits.size() == 3 ? rgb << 8 | *digit * 17 : rgb << 4 | *digit;
  }
  return rgb;
}

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return out;
}

}  // namespace

std::optional<std::uint32_t> parse_colour(std::string_view text) {
  std::string name = lower(trimmed(text));
  if (name.starts_with('#')) return parse_hex(std::string_view(name).substr(1));
  std::erase_if(name, [](char c) { return c == '_' || c == '-' || c == ' '; });
  if (const auto rgb = find_named(kColours, name)) return rgb;
  return parse_hex(name).has_value() && name.size() == 6 ? parse_hex(name) : std::nullopt;
}

std::optional<std::uint32_t> material_colour(std::string_view material) {
  return find_named(kMaterials, lower(trimmed(material)));
}

}  // namespace manzana

#include "scenegraph/import/osm_values.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace manzana {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool is_number_char(char c) { return (c >= '0' && c <= '9') || c == '.' || c == ',' || c == '-' || c == '+'; }

/// Takes a number and the white space after it off the front of `text`.
std::optional<double> take_number(std::string_view& text) {
  std::size_t length = 0;
  while (length < text.size() && is_number_char(text[length])) ++length;
  // An exponent: only with digits behind it, so that "3 e" and "4em" stay words.
  if (length > 0 && length + 1 < text.size() && (text[length] == 'e' || text[length] == 'E') &&
      is_number_char(text[length + 1])) {
    ++length;
    while (length < text.size() && is_number_char(text[length])) ++length;
  }
  std::string digits(text.substr(0, length));
  for (char& c : digits) c = c == ',' ? '.' : c;
  const char* first = digits.data() + (digits.starts_with('+') ? 1 : 0);
  double value = 0;
  const auto [end, error] = std::from_chars(first, digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value)) return std::nullopt;
  text = trimmed(text.substr(length));
  return value;
}

struct Unit {
  std::string_view name;
  double metres;
};
constexpr std::array<Unit, 20> kUnits{{{"m", 1},           {"metre", 1},       {"metres", 1},      {"meter", 1},
                                       {"meters", 1},      {"km", 1000},       {"cm", 0.01},       {"mm", 0.001},
                                       {"mi", 1609.344},   {"ft", 0.3048},     {"feet", 0.3048},   {"foot", 0.3048},
                                       {"'", 0.3048},      {"\u2032", 0.3048}, {"in", 0.0254},     {"inch", 0.0254},
                                       {"inches", 0.0254}, {"\"", 0.0254},     {"\u2033", 0.0254}, {"''", 0.0254}}};

/// Takes a unit off the front of `text`: everything up to the next digit. None is metres.
std::optional<double> take_unit(std::string_view& text) {
  std::size_t length = 0;
  const auto ends = [](char c) { return (c >= '0' && c <= '9') || c == '-' || c == '+' || is_space(c); };
  while (length < text.size() && !ends(text[length])) ++length;
  std::string name(text.substr(0, length));
  for (char& c : name) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  if (name.ends_with('.')) name.pop_back();
  text = trimmed(text.substr(length));
  if (name.empty()) return 1.0;
  for (const Unit& unit : kUnits) {
    if (unit.name == name) return unit.metres;
  }
  return std::nullopt;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

std::optional<double> parse_number(std::string_view text) {
  text = trimmed(text);
  const auto value = take_number(text);
  return text.empty() ? value : std::nullopt;
}

std::optional<double> parse_length(std::string_view text) {
  text = trimmed(text);
  const auto first = take_number(text);
  if (!first) return std::nullopt;
  const auto unit = take_unit(text);
  if (!unit) return std::nullopt;
  double metres = *first * *unit;
  if (!text.empty()) {  // feet and inches
    const auto second = take_number(text);
    const auto smaller = take_unit(text);
    if (!second || !smaller || *smaller >= *unit || *second < 0 || !text.empty()) return std::nullopt;
    metres += *second * *smaller;
  }
  return std::isfinite(metres) ? std::optional(metres) : std::nullopt;
}

bool says_yes(const char* value) {
  if (value == nullptr) return false;
  const std::string_view text = trimmed(value);
  return !text.empty() && text != "no" && text != "0" && text != "false" && text != "none";
}

}  // namespace manzana

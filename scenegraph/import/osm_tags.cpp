#include "scenegraph/import/osm_tags.h"

#include <algorithm>

#include "scenegraph/import/osm_values.h"

namespace manzana {

std::uint32_t row_of(const osmium::TagList& tags, const std::string& source, AttributeWriter& attributes,
                     const osmium::TagList* more) {
  if (!attributes.wanted()) return 0;
  std::vector<AttributeWriter::Given> given;
  for (const osmium::Tag& tag : tags) given.emplace_back(tag.key(), tag.value());
  if (more != nullptr && more != &tags)
    for (const osmium::Tag& tag : *more) given.emplace_back(tag.key(), tag.value());
  return attributes.row(given, source);
}

std::string_view TagReader::text(const char* key) const {
  const char* value = tags_[key];
  return value == nullptr ? std::string_view() : std::string_view(value);
}

bool TagReader::yes(const char* key) const { return says_yes(tags_[key]); }

std::optional<double> TagReader::length(const char* key, ValueRange metres) {
  return has(key) ? checked(key, parse_length(text(key)), metres, "is not a length") : std::nullopt;
}

std::optional<double> TagReader::number(const char* key, ValueRange range) {
  return has(key) ? checked(key, parse_number(text(key)), range, "is not a number") : std::nullopt;
}

std::optional<std::uint32_t> TagReader::colour(const char* key) {
  if (!has(key)) return std::nullopt;
  const auto rgb = parse_colour(text(key));
  if (!rgb) complain(key, "is not a colour");
  return rgb;
}

void TagReader::complain(const char* key, const char* what) {
  std::string value(text(key).substr(0, 40));
  std::ranges::replace_if(
      value, [](char c) { return c < 32 || c > 126; }, '?');
  issues_.push_back({where_, std::string(key) + " '" + value + "' " + what});
}

std::optional<double> TagReader::checked(const char* key, std::optional<double> value, ValueRange range,
                                         const char* no_value) {
  if (value && *value >= range.least && *value <= range.most) return value;
  complain(key, value ? "is out of range" : no_value);
  return std::nullopt;
}

}  // namespace manzana

#pragma once
/// Tags of one feature, read with complaints: a value that says nothing usable is listed as an issue and passed over.
///   TagReader tags(*area.tags, area.where, issues);
///   const auto height = tags.length("height", {0.1, 1000});
#include <optional>
#include <osmium/osm/tag.hpp>
#include <string>
#include <vector>

#include "scenegraph/import/features.h"

namespace manzana {

struct ValueRange {
  double least, most;
};

/// All tags, as they are, of what the API of OpenStreetMap knows as `source`; then those of `more` that say something
/// else.
std::uint32_t row_of(const osmium::TagList& tags, const std::string& source, AttributeWriter& attributes,
                     const osmium::TagList* more = nullptr);

class TagReader {
 public:
  TagReader(const osmium::TagList& tags, const std::string& where, std::vector<Issue>& issues)
      : tags_(tags), where_(where), issues_(issues) {}

  /// "" where the key is absent.
  std::string_view text(const char* key) const;
  bool is(const char* key, std::string_view value) const { return text(key) == value; }
  bool has(const char* key) const { return tags_.has_key(key); }
  bool yes(const char* key) const;
  std::optional<double> length(const char* key, ValueRange metres);
  std::optional<double> number(const char* key, ValueRange range);
  std::optional<std::uint32_t> colour(const char* key);
  /// "KEY 'VALUE' WHAT", with what cannot be printed made so.
  void complain(const char* key, const char* what);

 private:
  std::optional<double> checked(const char* key, std::optional<double> value, ValueRange range, const char* no_value);

  const osmium::TagList& tags_;
  const std::string& where_;
  std::vector<Issue>& issues_;
};

}  // namespace manzana

#include <charconv>
#include <stdexcept>
#include <string>

#include "gl/context.h"
#include "manzana_draw_tables.h"
#include "scenegraph/draw/renderer.h"

namespace manzana::draw {
namespace {

/// What lies before the next `end`, and takes it away.
std::string_view cut(std::string_view& text, char end) {
  const std::size_t at = std::min(text.find(end), text.size());
  const std::string_view part = text.substr(0, at);
  text.remove_prefix(std::min(at + 1, text.size()));
  return part;
}

template <class Number>
Number number(std::string_view text) {
  Number value{};
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

Quality row_of(std::string_view line) {
  Quality quality;
  quality.name = cut(line, ',');
  quality.tree_law = foliage::law_named(cut(line, ','));
  quality.tree_error_px = number<double>(cut(line, ','));
  quality.samples = number<int>(line);
  return quality;
}

std::vector<Quality> qualities() {
  std::vector<Quality> all;
  std::string_view text = tables::quality_csv;
  cut(text, '\n');  // the columns' names
  while (!text.empty()) all.push_back(row_of(cut(text, '\n')));
  all.push_back({"exact", 8, 0.01, foliage::Law::full});
  return all;
}

}  // namespace

Quality quality_for(std::string_view renderer) {
  if (!gl::software_renderer(renderer)) return quality_named("balanced");
  Quality quality = quality_named("fast");
  quality.samples = 1;
  return quality;
}

std::vector<std::string> quality_names() {
  std::vector<std::string> names;
  for (const Quality& quality : qualities()) names.push_back(quality.name);
  return names;
}

Quality quality_named(std::string_view name) {
  std::string known;
  for (const Quality& quality : qualities()) {
    if (quality.name == name) return quality;
    known += (known.empty() ? "" : ", ") + quality.name;
  }
  throw std::invalid_argument("no quality is named \"" + std::string(name) + "\": " + known);
}

}  // namespace manzana::draw

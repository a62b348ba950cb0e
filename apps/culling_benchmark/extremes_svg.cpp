#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "apps/culling_benchmark/extremes_tables.h"

namespace manzana::culling_benchmark {
namespace {

constexpr std::size_t kCell = 15, kLeft = 220, kTop = 116, kGap = 24;  // pixels

std::string text_at(int x, int y, const std::string& attributes, const std::string& text) {
  return "<text x=\"" + std::to_string(x) + "\" y=\"" + std::to_string(y) + "\" " + attributes + ">" + text +
         "</text>\n";
}

/// Green for none; from pale yellow for one in 10 000 to dark red for all, by the exponent.
std::string colour(double share) {
  if (share <= 0) return "#d5ead3";
  const double t = std::clamp((std::log10(share) + 4) / 4, 0.0, 1.0);
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", static_cast<int>(255 - 115 * t * t),
                static_cast<int>(236 * (1 - t)), static_cast<int>(160 * (1 - t)));
  return text.data();
}

/// Names in the order of their first rows.
std::vector<std::string> names(const Extremes& extremes, const ExtremesKey& key) {
  std::vector<std::string> all;
  for (const ExtremesRow& row : extremes.rows)
    if (const std::string name = key(row); std::find(all.begin(), all.end(), name) == all.end()) all.push_back(name);
  return all;
}

std::size_t index_of(const std::vector<std::string>& all, const std::string& name) {
  return static_cast<std::size_t>(std::find(all.begin(), all.end(), name) - all.begin());
}

/// Of "0.1 / 5 000", for two lines.
std::pair<std::string, std::string> halves(const std::string& depths) {
  const std::size_t at = depths.find('/');
  return {depths.substr(0, at), depths.substr(at)};
}

/// Where the cells are: columns by sort, depths, field of view; rows by place, way.
struct Grid {
  std::vector<std::string> sorts, depths, fields, places, ways;
  explicit Grid(const Extremes& e)
      : sorts(names(e, [](const ExtremesRow& r) { return r.objects; })),
        depths(names(e, by_depths)),
        fields(names(e, by_field)),
        places(names(e, [](const ExtremesRow& r) { return r.place; })),
        ways(names(e, [](const ExtremesRow& r) { return r.way; })) {}
  int x(std::size_t sort, std::size_t depth, std::size_t field) const {
    const std::size_t group = fields.size() * kCell + 3;
    return static_cast<int>(kLeft + sort * (depths.size() * group + kGap) + depth * group + field * kCell);
  }
  int y(std::size_t place, std::size_t way) const {
    return static_cast<int>(kTop + place * (ways.size() * kCell + 6) + way * kCell);
  }
};

std::string cell(const Grid& grid, const ExtremesRow& r) {
  const int x =
      grid.x(index_of(grid.sorts, r.objects), index_of(grid.depths, by_depths(r)), index_of(grid.fields, by_field(r)));
  const int y = grid.y(index_of(grid.places, r.place), index_of(grid.ways, r.way));
  const double share = r.seen > 0 ? static_cast<double>(r.missed) / static_cast<double>(r.seen) : 0;
  return "<rect x=\"" + std::to_string(x) + "\" y=\"" + std::to_string(y) + "\" width=\"14\" height=\"14\" fill=\"" +
         colour(share) + "\"><title>" + r.place + ", " + by_depths(r) + " m, " + by_field(r) + " degrees, " + r.way +
         ", " + r.objects + ": " + std::to_string(r.missed) + " of " + std::to_string(r.seen) +
         " missed</title></rect>\n";
}

std::string labels(const Grid& grid) {
  std::string text;
  for (std::size_t place = 0; place < grid.places.size(); ++place) {
    text += text_at(6, grid.y(place, 0) + 12, "font-weight=\"bold\"", grid.places[place]);
    for (std::size_t way = 0; way < grid.ways.size(); ++way)
      text += text_at(kLeft - 8, grid.y(place, way) + 12, "text-anchor=\"end\"", grid.ways[way]);
  }
  for (std::size_t sort = 0; sort < grid.sorts.size(); ++sort) {
    text += text_at(grid.x(sort, 0, 0), 40, "font-weight=\"bold\"", grid.sorts[sort] + " objects");
    for (std::size_t depth = 0; depth < grid.depths.size(); ++depth) {
      const auto [near_m, far_m] = halves(grid.depths[depth]);
      text += text_at(grid.x(sort, depth, 0), 56, "", near_m) + text_at(grid.x(sort, depth, 0), 69, "", far_m);
      for (std::size_t field = 0; field < grid.fields.size(); ++field) {
        const std::string at = std::to_string(grid.x(sort, depth, field) + 11) + " " + std::to_string(kTop - 4);
        text += "<text transform=\"translate(" + at + ") rotate(-90)\">" + grid.fields[field] + "</text>\n";
      }
    }
  }
  return text;
}

}  // namespace

std::string extremes_svg(const Extremes& extremes) {
  const Grid grid(extremes);
  const int width = grid.x(grid.sorts.size(), 0, 0), height = grid.y(grid.places.size(), 0) + 10;
  std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + std::to_string(width) + "\" height=\"" +
                     std::to_string(height) + "\" font-family=\"sans-serif\" font-size=\"11\">\n" +
                     "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n" +
                     text_at(6, 18, "font-size=\"14\"",
                             "Missed, of what is in view: green none, pale yellow 1 in 10 000, dark red all. Columns: "
                             "near / far plane in metres, field of view in degrees.");
  text += labels(grid);
  for (const ExtremesRow& row : extremes.rows) text += cell(grid, row);
  return text + "</svg>\n";
}

}  // namespace manzana::culling_benchmark

#include <charconv>
#include <optional>
#include <stdexcept>

#include "scenegraph/import/baked_city.h"
#include "scenegraph/import/cityjson.h"
#include "scenegraph/import/gis_vectors.h"
#include "scenegraph/import/import.h"

namespace manzana {
namespace {

constexpr std::string_view kTown = "builtin:town";
constexpr double kLargestTown = 1000;  // times

/// How many times as large a town of that name is; none: it is not one.
std::optional<double> town_times(std::string_view name) {
  if (name == kTown) return 1;
  if (!name.starts_with(kTown) || name.size() < kTown.size() + 2 || name[kTown.size()] != ':') return {};
  const char *first = name.data() + kTown.size() + 1, *last = name.data() + name.size();
  double times = 0;
  const auto [end, error] = std::from_chars(first, last, times);
  if (error != std::errc{} || end != last || !(times >= 1 && times <= kLargestTown)) return {};
  return times;
}

}  // namespace

CityFeatures read_city(const std::string& city, const ImportOptions& options, const Progress& progress) {
  if (const auto times = town_times(city)) return make_town(options.seed, *times);
  if (city.starts_with("builtin:"))
    throw std::runtime_error(city + ": there is only builtin:town, and builtin:town:10 for one ten times as large");
  if (is_baked(city)) throw std::runtime_error(city + ": a baked city stands on its ground already, and gets no other");
  if (is_gis_vectors(city)) return read_gis_vectors(city, {}, options);
  return is_cityjson(city) ? read_cityjson(city, options, progress) : read_osm(city, progress, options.attributes);
}

Imported import_city(const std::string& city, const ImportOptions& options, const Progress& progress) {
  if (is_baked(city)) return read_baked(city);
  return build_scene(read_city(city, options, progress), options, progress);
}

}  // namespace manzana

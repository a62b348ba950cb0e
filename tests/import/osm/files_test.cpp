// Real extracts: counts against what other tools count in them.
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <set>
#include <string>

#include "scenegraph/import/import.h"
#include "tests/support/data.h"

using namespace manzana;

namespace {

/// What osmium-tool and scripts count in the file (MANIFEST.md of the data): objects by their tags alone.
struct Facts {
  const char* file;
  std::size_t buildings, parts;  ///< ways and relations tagged building; ways and relations tagged building:part
  std::size_t streets;           ///< ways tagged highway
  std::size_t trees;             ///< nodes natural=tree
  std::size_t tree_rows;
  std::size_t lost_buildings;  ///< at most: cut at the edge, not closed there, drawn by their parts, under the ground
  double lost_streets;         ///< share: areas, indoors, no nodes in the file, kinds that are no streets
};

template <class Features>
std::size_t objects(const Features& features) {
  std::set<std::string> names;
  for (const auto& f : features) names.insert(f.where);
  return names.size();
}

bool finite(const std::vector<Vec2d>& points) {
  for (const Vec2d& p : points)
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return false;
  return true;
}

void check_sound(const CityFeatures& city) {
  for (const BuildingFeature& b : city.buildings) {
    CAPTURE(b.where);
    const bool heights = b.height > b.min_height && b.min_height >= 0 && b.roof_height >= 0 &&
                         b.roof_height <= b.height - b.min_height + 1e-9 && b.height <= 1000 && b.levels >= 1;
    if (!heights || b.footprint.outer.size() < 3 || !finite(b.footprint.outer)) FAIL_CHECK("unsound building");
  }
  for (const StreetFeature& s : city.streets) {
    CAPTURE(s.where);
    const bool sound = s.line.size() == s.nodes.size() && s.line.size() >= 2 && s.width > 0 && s.lanes >= 1;
    if (!sound || !finite(s.line)) FAIL_CHECK("unsound street");
  }
  for (const TreeFeature& t : city.trees) {
    const bool sound = t.height > 0 && t.height <= 120 && t.crown_radius > 0 && t.crown_radius <= 30;
    if (!sound || !std::isfinite(t.position.x + t.position.y)) FAIL_CHECK("unsound tree");
  }
  for (const AreaFeature& a : city.areas)
    if (a.shape.outer.size() < 3 || !finite(a.shape.outer) || !(a.trees_per_ha >= 0)) FAIL_CHECK(a.where);
}

}  // namespace

TEST_CASE("real files hold what they are known to hold") {
  // clang-format off
  const auto facts = GENERATE(
      Facts{"tiny/helsinki-block.osm", 8, 5, 19, 15, 0, 2, 0.1},
      Facts{"tiny/helsinki-block.osm.pbf", 78, 18, 251, 65, 0, 16, 0.1},
      Facts{"tiny/nyc-block.osm.pbf", 84, 1, 23, 0, 0, 1, 0.1},
      Facts{"tiny/porto-alegre-streets.osm.pbf", 2, 0, 213, 0, 0, 0, 0.05},
      Facts{"tiny/triesen-trees.osm.pbf", 27, 0, 30, 198, 0, 0, 0},
      Facts{"osm/heidelberg.osm.pbf", 1372, 0, 508, 125, 0, 5, 0.05},
      Facts{"osm/helsinki-centre.osm.pbf", 500, 139, 2650, 649, 8, 85, 0.2},
      Facts{"osm/liechtenstein-2015.osm.pbf", 8997, 0, 4660, 3000, 0, 8, 0.001},
      Facts{"osm/north-bayreuth.osm.gz", 4267, 0, 2056, 20, 0, 2, 0.001},
      Facts{"osm/nyc-lower-east-side.osm.pbf", 1383, 134, 465, 11, 1, 125, 0.15},
      Facts{"osm/porto-alegre.osm.pbf", 19, 0, 15886, 1, 0, 1, 0.03});
  // clang-format on
  CAPTURE(facts.file);
  const auto file = data_file(facts.file);
  if (!file) return;
  const auto start = std::chrono::steady_clock::now();
  const CityFeatures city = read_osm(*file, {});
  WARN(facts.file << ": " << std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() << " s, "
                  << objects(city.buildings) << " buildings and parts, " << city.streets.size() << " streets, "
                  << city.trees.size() << " trees, " << city.issues.size() << " issues");
  CHECK(objects(city.buildings) <= facts.buildings + facts.parts);
  CHECK(objects(city.buildings) + facts.lost_buildings >= facts.buildings + facts.parts);
  CHECK(city.streets.size() <= facts.streets);
  CHECK(static_cast<double>(city.streets.size()) >= static_cast<double>(facts.streets) * (1 - facts.lost_streets));
  if (facts.tree_rows == 0) CHECK(city.trees.size() == facts.trees);
  if (facts.tree_rows > 0) CHECK(city.trees.size() > facts.trees);
  CHECK(city.attribution == "© OpenStreetMap contributors");
  check_sound(city);
}

TEST_CASE("heights of Manhattan come from the file") {
  const auto file = data_file("osm/nyc-lower-east-side.osm.pbf");
  if (!file) return;
  const CityFeatures city = read_osm(*file, {});
  std::size_t odd = 0, high = 0;  // by rule, heights are 0.5 m + 3 m a level + a roof: told ones are other numbers
  for (const BuildingFeature& b : city.buildings) {
    const double levels = (b.height - b.roof_height - 0.5) / 3;
    odd += std::abs(levels - std::round(levels)) > 1e-9 ? 1 : 0;
    high += b.height > 40 ? 1 : 0;
  }
  CHECK(odd > city.buildings.size() * 9 / 10);
  CHECK(high > 10);
}

TEST_CASE("reading twice gives the same") {
  const auto file = data_file("osm/helsinki-centre.osm.pbf");
  if (!file) return;
  const CityFeatures a = read_osm(*file, {}), b = read_osm(*file, {});
  REQUIRE(a.buildings.size() == b.buildings.size());
  for (std::size_t i = 0; i < a.buildings.size(); ++i) {
    const BuildingFeature &x = a.buildings[i], &y = b.buildings[i];
    const bool same = x.where == y.where && x.height == y.height && x.wall_rgb == y.wall_rgb &&
                      x.roof_rgb == y.roof_rgb && x.footprint.outer == y.footprint.outer;
    if (!same) FAIL_CHECK(x.where);
  }
  CHECK(a.issues.size() == b.issues.size());
}

TEST_CASE("progress grows to the end") {
  const auto file = data_file("osm/north-bayreuth.osm.gz");
  if (!file) return;
  double last = 0;
  std::size_t calls = 0;
  read_osm(*file, [&](std::string_view stage, double fraction) {
    CHECK(stage == "reading");
    CHECK(fraction >= last);
    last = fraction;
    ++calls;
  });
  CHECK(calls >= 2);
  CHECK(last > 0.5);
  CHECK(last <= 1);
}

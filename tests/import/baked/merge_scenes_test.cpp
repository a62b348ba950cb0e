// Cities that are there already become one: nothing moves on the Earth, nothing is lost, and the file of it is sound.
#include <algorithm>
#include <catch2/catch.hpp>

#include "scenegraph/import/baked_city.h"
#include "scenegraph/visible.h"

using namespace manzana;

namespace {

Imported village_at(const GeoPoint& anchor) {
  CityFeatures features = read_city(MANZANA_VILLAGE, {.attributes = true}, {});
  features.frame = LocalFrame(anchor);
  return build_scene(std::move(features), {.cars = 40, .attributes = true}, {});
}
const GeoPoint kHere{48.1, 11.5, 0}, kThere{48.14, 11.53, 0};  // five kilometres

Imported back(const Imported& city) {
  const std::string bytes = baked_bytes(city);
  return read_baked_bytes(std::as_bytes(std::span(bytes.data(), bytes.size())), "x.manzana");
}

using Place = std::array<double, 3>;
Place place_of(const Scene& scene, const Vec3d& local) {
  const GeoPoint p = scene.frame.to_geo(local);
  return {p.lat_deg, p.lon_deg, p.height_m};
}

/// Every corner of every building and ground, every foot and every car, on the Earth.
std::vector<Place> places(const Scene& scene) {
  std::vector<Place> out;
  for (const MeshLayer* layer : {&scene.buildings, &scene.surfaces})
    for (const std::uint32_t i : layer->mesh.indices) {
      const CityVertex& v = layer->mesh.vertices[i];
      out.push_back(place_of(scene, scene.blocks[v.block].to_local(v.position)));
    }
  for (const TreeInstance& t : scene.trees.instances)
    out.push_back(place_of(scene, scene.blocks[t.block].to_local(t.position)));
  for (std::uint32_t car = 0; car < scene.traffic.cars(); ++car)
    out.push_back(place_of(scene, car_at(scene.traffic, car, ticks(100)).position));
  return out;
}

constexpr double kDegrees = 1e-10, kMetres = 1e-5;  // ten micrometres: floats of blocks and doubles of frames

bool nearly(const Place& a, const Place& b) {
  return std::abs(a[0] - b[0]) < kDegrees && std::abs(a[1] - b[1]) < kDegrees && std::abs(a[2] - b[2]) < kMetres;
}

/// Whether both have the same, in whatever order.
bool same_places(const std::vector<Place>& a, std::vector<Place> b) {
  std::sort(b.begin(), b.end());
  std::vector<bool> taken(b.size());
  const auto takes = [&](const Place& p) {
    for (auto at = std::lower_bound(b.begin(), b.end(), Place{p[0] - kDegrees, -1e9, -1e9});
         at != b.end() && (*at)[0] < p[0] + kDegrees; ++at) {
      const auto i = static_cast<std::size_t>(at - b.begin());
      if (!taken[i] && nearly(*at, p)) return static_cast<bool>(taken[i] = true);
    }
    return false;
  };
  return a.size() == b.size() && std::ranges::all_of(a, takes);
}

std::vector<std::string> said(const Scene& scene) {
  std::vector<std::string> all;
  for (std::uint32_t o = 0; o < scene.tree.objects(); ++o) {
    std::string text = std::to_string(scene.tree.classes[o]);
    for (std::size_t i = 0; i < scene.attributes.of(o).size(); ++i) {
      const auto [name, value] = scene.attributes.of(o)[i];
      text.append(" ").append(name).append("=").append(value);
    }
    all.push_back(text);
  }
  std::sort(all.begin(), all.end());
  return all;
}

std::vector<std::string> both(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  std::sort(a.begin(), a.end());
  return a;
}

/// All that a query of everything finds.
std::size_t seen(const Scene& scene) {
  VisibleSets sets(scene);
  const Vec3d middle = center(scene.bounds);
  find_visible(scene, culling::look(middle + Vec3d(0, 0, 1e5), {0, 0, -1}, {0, 1, 0}, 1, 1), Structure::bqr, sets);
  find_cars(scene, ticks(100), sets);
  return count(scene.buildings.table, sets.objects()) + count(scene.surfaces.table, sets.objects()) +
         count(scene.trees.table, sets.objects()) + sets.cars.size();
}

}  // namespace

TEST_CASE("merge: of two cities everything stays where it is and is what it was") {
  const Imported a = village_at(kHere), b = village_at(kThere);
  const Imported all = merge({back(a), back(b)});
  CHECK(all.scene.frame.anchor().lat_deg == kHere.lat_deg);
  CHECK(all.report.objects == a.report.objects + b.report.objects);
  CHECK(all.report.blocks == a.report.blocks + b.report.blocks);
  CHECK(all.report.fallback_objects == a.report.fallback_objects + b.report.fallback_objects);
  CHECK(all.scene.tree.objects() == all.report.objects);
  std::vector<Place> expected = places(a.scene);
  std::ranges::copy(places(b.scene), std::back_inserter(expected));
  CHECK(same_places(places(all.scene), expected));
  CHECK(said(all.scene) == both(said(a.scene), said(b.scene)));
  CHECK(seen(all.scene) == all.report.objects + a.scene.traffic.cars() + b.scene.traffic.cars());
  CHECK(all.scene.attribution == a.scene.attribution);
  CHECK(seen(back(all).scene) == seen(all.scene));  // sound
}

TEST_CASE("merge: coarser levels come along") {
  Imported a = village_at(kHere);
  MeshRows& level = a.scene.buildings.levels[1];
  level.index_first.back() = 3;
  level.mesh.indices.own() = {0, 1, 2};
  const auto corners = a.scene.buildings.mesh.vertices.items();
  level.mesh.vertices.own().assign(corners.end() - 3, corners.end());
  const Imported all = merge({back(a), back(village_at(kThere))});
  const MeshRows& kept = all.scene.buildings.levels[1];
  REQUIRE(kept.mesh.indices.size() == 3);
  REQUIRE(kept.index_first.size() == all.scene.buildings.table.size() + 1);
  const auto row = std::ranges::adjacent_find(kept.index_first, std::less<>()) - kept.index_first.begin();
  const std::uint32_t first = all.scene.buildings.index_first[static_cast<std::size_t>(row)];
  CHECK(kept.mesh.vertices[0].block ==
        all.scene.buildings.mesh.vertices[all.scene.buildings.mesh.indices[first]].block);
}

TEST_CASE("merge: a baked city and features, and one that says nothing of things") {
  const Imported a = village_at(kHere);
  CityFeatures features = read_city(MANZANA_VILLAGE, {}, {});
  features.frame = LocalFrame(kThere);
  const Imported plain = build_scene(std::move(features), {.cars = 0}, {});
  const Imported all = merge({plain, back(a)});
  CHECK(all.scene.frame.anchor().lat_deg == kThere.lat_deg);
  CHECK(said(all.scene) == both(said(a.scene), said(plain.scene)));
  CHECK(seen(back(all).scene) == seen(a.scene) + seen(plain.scene));
}

TEST_CASE("merge: one city alone is as it was, and with nothing to the bit in its tables") {
  const Imported a = village_at(kHere);
  CHECK(baked_bytes(merge({a})) == baked_bytes(a));
  const Imported all = merge({a, build_scene(CityFeatures(), {}, {})});
  CHECK(all.scene.buildings.mesh.indices.size() == a.scene.buildings.mesh.indices.size());
  CHECK(all.scene.trees.table.row_first == a.scene.trees.table.row_first);
  CHECK(all.scene.tree.order.size() == a.scene.tree.order.size());
  CHECK(all.scene.traffic.offsets == a.scene.traffic.offsets);
}

TEST_CASE("merge: a city on another continent is left out and told") {
  const Imported a = village_at(kHere), far = village_at({-33, 151, 0});
  const Imported all = merge({a, far});
  CHECK(all.report.objects == a.report.objects);
  REQUIRE(all.issues.size() == a.issues.size() + 1);
  CHECK(std::ranges::any_of(all.issues, [&](const Issue& issue) {
    return issue.where == "another source" && issue.what.starts_with(std::to_string(far.report.objects) + " objects");
  }));
}

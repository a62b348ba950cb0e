// Deussen 2005: the field, the herb of 106 lines, points as large as one likes.
#include <algorithm>
#include <cmath>

#include "apps/common/markdown.h"
#include "apps/foliage_benchmark/ground.h"
#include "apps/foliage_benchmark/portrait.h"
#include "apps/foliage_benchmark/stand_in.h"
#include "apps/foliage_benchmark/times_md.h"
#include "foliage/import/turtle.h"
#include "foliage/prepare.h"
#include "foliage_benchmark_parts_plants.h"

namespace manzana::foliage_benchmark {
namespace {

using foliage::Law;
using foliage::PreparedPlant;

constexpr const char* kField = "Deussen 2005, field";
constexpr const char* kPoints = "Deussen 2005, figure 10.17";
constexpr const char* kHerb = "Deussen 2005, figure 10.14";
constexpr std::uint32_t kFieldPlants = 1500, kFieldTriangles = 12'000'000;  // [Deussen 2005, figure 10.14]

/// [Deussen 2005, equation 10.5] c_p A / d'^2 points, each d' wide.
Detail points_of(const PreparedPlant& plant, double c, double d_m) {
  Detail detail = leaves_as_points(plant, c);
  const double most = static_cast<double>(detail.points);
  const double wanted = std::clamp(c * static_cast<double>(plant.point_levels.front().area) / (d_m * d_m), 1.0, most);
  detail.points = static_cast<float>(wanted);
  detail.point_gain = static_cast<float>(c / wanted);
  return detail;
}

void add_point_sweep(const Effort& effort, const PreparedPlant& plant, Times& times) {
  constexpr double kHeightPx = 64;
  if (plant.point_levels.empty()) return;
  Lazy<Portrait> portrait([&] { return Portrait(plant, kHeightPx); });
  const double pixel_m = static_cast<double>(plant.height_m) / kHeightPx;
  for (const double size_px : {1.0, 1.5, 2.0, 3.0}) {
    for (const double c : {1.0, 1.2, 1.5, 2.0, 3.0}) {
      if (effort.quick && c != 1.2 && size_px != 1.5) continue;
      times.add({.table = kPoints,
                 .plant = plant.name,
                 .way = "c_p " + apps::digits3(c) + ", points of " + apps::digits3(size_px) + " px",
                 .reference = "all detail"},
                [&](TimeRow& row) { portrait->look(points_of(plant, c, size_px * pixel_m), all_detail(plant), row); });
    }
  }
}

PreparedPlant herb() {
  PreparedPlant plant = prepare(grow_plant(foliage::parse_lsystems(plants::herb_json).front()), {.visibility_side = 0});
  plant.name = "herb";
  return plant;
}

/// A small plant's stems as lines against its triangles, and as ours has it, from near to far.
void add_herb(Times& times) {
  Lazy<PreparedPlant> plant(herb);
  for (const double height_px : {256.0, 128.0, 64.0, 32.0, 16.0}) {
    Lazy<Portrait> portrait([&] { return Portrait(*plant, height_px); });
    const std::string at = " at " + std::to_string(std::lround(height_px)) + " px";
    const auto add = [&](const std::string& way, const std::function<Detail(const PreparedPlant&)>& detail) {
      times.add({.table = kHerb, .plant = "herb", .way = way + at, .reference = "all detail"}, [&](TimeRow& row) {
        portrait->look(detail(*plant), all_detail(*plant), row);
        set_shown(portrait->stage().shown(), row);
      });
    };
    add("stems as lines", [](const PreparedPlant& p) {
      return at_branch_level(p, static_cast<std::uint32_t>(p.branch_levels.size()), true);
    });
    add("ours", [&](const PreparedPlant& p) {
      const double error_m = static_cast<double>(p.height_m) / height_px;
      foliage::PlantTable table = foliage::make_plant_table({&p, 1});
      table.details = make_details({&p, 1}, Law::ours);
      return detail_at(table, 0, static_cast<float>(error_m * error_m));
    });
  }
}

/// A field of it has as many triangles as the source's.
PreparedPlant plant_of_the_field() {
  PreparedPlant plant = prepare(grown_to("broadleaf", 1.0 * kFieldTriangles / kFieldPlants), {.visibility_side = 0});
  plant.name = "broadleaf";
  return plant;
}

}  // namespace

void add_deussen(const Effort& effort, std::span<const PreparedPlant> plants, Times& times) {
  times.add({.table = kField, .plant = "broadleaf", .way = "ours", .reference = "all detail of some, scaled"},
            [&](TimeRow& row) {
              const PreparedPlant plant = plant_of_the_field();
              const std::span one(&plant, 1);
              const double spacing = 1.6 * static_cast<double>(plant.crown_radius_m);
              const double half = spacing * std::sqrt(kFieldPlants) / 2;
              Ground ground(one, make_forest(one, kFieldPlants, spacing, 5), effort.quick ? 4e4 : 2e5);
              const Vec3d eye(-half * 1.2, 0, 2 * static_cast<double>(plant.height_m));
              ground.measure(screen_shot(eye, {1, 0, -0.15}, effort.screen_height()), {}, effort.seconds(), row);
            });
  add_herb(times);
  add_point_sweep(effort, plants.front(), times);
  times.text +=
      "## Deussen 2005: Digital Design of Nature, chapter 10\n\nA field of 1 500 plants whose leaves alone are 8 000 "
      "triangles each, 12 000 000 in all as in the source; 16 : 9, seen from its edge. The reference's are those of "
      "all "
      "plants in view.\n\n" +
      rows_md(times.rows, kField) +
      "Figure 10.14: a small plant whose stems are 106 lines or fewer, from near to far.\n\n" +
      rows_md(times.rows, kHerb) +
      "Figure 10.17: leaves as c_p A / d'^2 points of d', a plant 64 px high, without quads. Where there are no more "
      "points, those there are count.\n\n" +
      rows_md(times.rows, kPoints);
}

}  // namespace manzana::foliage_benchmark

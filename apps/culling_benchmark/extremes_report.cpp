#include <algorithm>
#include <cmath>

#include "apps/common/markdown.h"
#include "apps/culling_benchmark/extremes_tables.h"
#include "culling/baselines/naive.h"

namespace manzana::culling_benchmark {
namespace {

std::string by_place(const ExtremesRow& r) { return r.place; }

ExtremesFilter of_sort(const std::string& objects) {
  return [objects](const ExtremesRow& r) { return r.objects == objects; };
}

std::string missed(const ExtremesSum& s) { return apps::digits3(s.missed_percent()); }

ExtremesSum sum_of_bqr(const Extremes& e) {
  return sum(e, [](const ExtremesRow& r) { return r.way == "bqr"; });
}

std::string intro(const ExtremesOptions& o) {
  return "## Extremes\n" + std::to_string(o.cameras) +
         " cameras of random direction, 16:9, at every place, with every pair of depths and every field of view; " +
         std::to_string(o.objects) + " objects of each sort a camera (seed " + std::to_string(o.seed) +
         "). *Any*: boxes of 10 to 160 m, evenly spread over the view and a little round it, up to 1000 km away. "
         "*Touching*: such boxes that reach 1e-9 to 1e-1 m into the view, at a face, an edge or a corner of it. "
         "What is in view, separating axes say, in fifty digits where double is in doubt. The ways:\n\n";
}

std::string ways_md() {
  std::vector<std::vector<std::string>> cells{
      {"way", "what", "precision"},
      {"bqr", "this library: planes from the camera's parameters, a tree with margins for what is rounded",
       "float relative to the tree's origin"}};
  for (const baselines::NaiveWay& way : baselines::naive_ways())
    cells.push_back({std::string(way.slug), std::string(way.what), std::string(way.precision)});
  return apps::md_table(cells);
}

std::string missed_md(const Extremes& e) {
  std::string text = "### Missed, per cent of what is in view\n";
  for (const char* objects : {"any", "touching"}) {
    const auto which = of_sort(objects);
    text += std::string(objects) + " objects, by place:\n\n" + apps::md_table(pivot(e, which, by_place, missed));
    text += std::string(objects) + " objects, by near / far plane in metres:\n\n" +
            apps::md_table(pivot(e, which, by_depths, missed));
    text += std::string(objects) + " objects, by field of view in degrees:\n\n" +
            apps::md_table(pivot(e, which, by_field, missed));
  }
  text += "The deepest object missed, metres in view (any objects, by place):\n\n" +
          apps::md_table(pivot(e, of_sort("any"), by_place,
                               [](const ExtremesSum& s) { return apps::digits3(s.deepest_missed_m); }));
  return text;
}

std::string kept_md(const Extremes& e) {
  const auto kept = [](const ExtremesSum& s) { return apps::digits3(s.falsely_kept_percent()); };
  return "### Falsely kept, per cent of what is not in view (any objects)\nAll ways keep boxes that lie outside, "
         "beyond "
         "an edge of the view, but not wholly beyond one plane; what bqr keeps besides are its margins.\n\n" +
         apps::md_table(pivot(e, of_sort("any"), by_place, kept)) +
         apps::md_table(pivot(e, of_sort("any"), by_depths, kept)) +
         apps::md_table(pivot(e, of_sort("any"), by_field, kept));
}

std::string off_text(const FarRow& r) {
  if (r.without == r.cameras) return "none";
  const std::string off = apps::digits3(r.inward_m) + " / " + apps::digits3(r.outward_m);
  return r.without == 0 ? off : off + " (" + std::to_string(r.without) + " without)";
}

/// A row a way at one place, a column a pair of depths.
std::string far_md(const Extremes& e, const std::string& place) {
  std::vector<std::vector<std::string>> cells{{place}};
  for (const FarRow& r : e.far) {
    if (r.place != place) continue;
    const std::string name = r.way.starts_with("bqr") ? r.way + " in " + r.precision : r.way;
    const auto row = std::find_if(cells.begin() + 1, cells.end(), [&](const auto& c) { return c[0] == name; });
    const std::string depths = depths_text(r.near_m, r.far_m);
    if (std::find(cells[0].begin(), cells[0].end(), depths) == cells[0].end()) cells[0].push_back(depths);
    (row == cells.end() ? cells.emplace_back(1, name) : *row).push_back(off_text(r));
  }
  return apps::md_table(cells);
}

/// What was measured when the margins were designed (numerics E1 and 2.1), and the same of this run.
struct Earlier {
  std::string what, then;
  double then_value, now;
};

std::vector<Earlier> far_then_and_now(const Extremes& e) {
  const auto now = [&](const char* place, double far_m, const char* way) {
    for (const FarRow& r : e.far)
      if (r.place == place && r.far_m == far_m && r.near_m == 0.1 && r.way == way)
        return std::max(r.inward_m, r.outward_m);
    return 0.0;
  };
  return {{"far plane 0.1 / 5000, float, local, m", "11.5", 11.5, now("local", 5e3, "float-world")},
          {"the same at UTM coordinates", "4480", 4480, now("UTM", 5e3, "float-world")},
          {"the same in ECEF", "6300", 6300, now("ECEF", 5e3, "float-world")},
          {"the same, float relative to the eye", "10.9", 10.9, now("ECEF", 5e3, "float-eye")},
          {"the same, double in ECEF", "0.000015", 1.5e-5, now("ECEF", 5e3, "double-world")},
          {"far plane 0.1 / 100 000, float in ECEF, m", "102 000", 1.02e5, now("ECEF", 1e5, "float-world")},
          {"the same, float relative to the eye", "2720", 2720, now("ECEF", 1e5, "float-eye")},
          {"the same, double in ECEF", "0.0004", 4e-4, now("ECEF", 1e5, "double-world")}};
}

std::vector<Earlier> missed_then_and_now(const Extremes& e) {
  const auto now = [&](const char* place, const char* way, const char* objects) {
    return sum(e,
               [&](const ExtremesRow& r) {
                 return r.place == place && r.way == way && r.objects == objects && r.near_m == 0.1 && r.far_m == 5e3 &&
                        r.fovy_deg == 60;
               })
        .missed_percent();
  };
  return {
      {"missed at UTM coordinates, float-world, %", "21.3", 21.3, now("UTM", "float-world", "any")},
      {"missed in ECEF, float-world, %", "17.3", 17.3, now("ECEF", "float-world", "any")},
      {"missed, float relative to the eye, %", "0", 0, now("ECEF", "float-eye-exact", "any")},
      {"missed of touching, the same, %", "26 to 43", 26, now("ECEF", "float-eye-exact", "touching")},
      {"missed of touching, double-world in ECEF, %", "0.01 to 0.03", 0.03, now("ECEF", "double-world", "touching")}};
}

std::string compared_md(const Extremes& e) {
  std::vector<std::vector<std::string>> cells{{"", "then", "now", "now / then"}};
  auto all = far_then_and_now(e);
  for (const Earlier& x : missed_then_and_now(e)) all.push_back(x);
  for (const Earlier& x : all)
    cells.push_back(
        {x.what, x.then, apps::digits3(x.now), x.then_value > 0 ? apps::digits3(x.now / x.then_value) : ""});
  return "### Beside the first measurements\nThe margins were designed on the figures in the column *then* (numerics, "
         "E1 and 2.1): the worst of 20 cameras, and spheres of 5 to 80 m, 0.1 / 5000 m, 60 degrees.\n\n" +
         apps::md_table(cells) +
         "Where these differ: the far plane of a world matrix in float moves in steps of half an ulp of the eye's "
         "coordinates over 2n/f, so its worst displacement, and the share that is lost, depend on which cameras were "
         "drawn; and more are drawn here. Touching objects were balls then, and are boxes here: a box is outside when "
         "a "
         "sum falls below zero, to which a sum of floats that is nearly zero often rounds, a ball when it falls below "
         "the radius, where nothing rounds to a tie; and half of the boxes touch near the eye. In double the planes "
         "then came from the camera's parameters; here they come from the matrix, and what is missed lies at its far "
         "plane, which is off by the metres above.\n\n";
}

}  // namespace

std::vector<std::string> extremes_faults(const Extremes& e) {
  const ExtremesSum ours = sum_of_bqr(e);
  if (ours.missed == 0) return {};
  return {"extremes: bqr missed " + apps::grouped(ours.missed) + " objects"};
}

std::string extremes_md(const Extremes& e) {
  const ExtremesSum ours = sum_of_bqr(e);
  return intro(e.options) + ways_md() + "bqr missed " + apps::grouped(ours.missed) + " of " + apps::grouped(ours.seen) +
         " objects in view.\n\n![what is missed](extremes.svg)\n\n" + missed_md(e) + kept_md(e) +
         "### The far plane that each way culls with\nToo near / too far, metres, the worst of " +
         std::to_string(e.far.empty() ? 0 : e.far.front().cameras) +
         " cameras; by near / far plane. None: its normal is nothing, or the library left it out because the matrix "
         "went through float.\n\n" +
         far_md(e, "local") + far_md(e, "UTM") + far_md(e, "ECEF") + compared_md(e);
}

}  // namespace manzana::culling_benchmark

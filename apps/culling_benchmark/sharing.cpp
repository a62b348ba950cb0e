#include "apps/culling_benchmark/sharing.h"

#include <tbb/task_arena.h>

#include <array>
#include <chrono>
#include <cmath>
#include <numbers>
#include <random>
#include <thread>

#include "apps/common/clock.h"
#include "apps/common/csv.h"
#include "apps/common/markdown.h"
#include "apps/common/statistics.h"
#include "culling/baselines/cases.h"
#include "files/whole_file.h"

namespace manzana::culling_benchmark {
namespace {

using baselines::City;
using baselines::ObjectKind;
using culling::View;

constexpr double kRoofs = 12;  // metres: the walls of nearly every block cross this height

using C = apps::Column<SharingRow>;
constexpr std::array kColumns{
    C{"objects", "", "in the city", &SharingRow::objects},
    C{"view", "", "what is asked", &SharingRow::view},
    C{"nodes", "", "visited", &SharingRow::nodes},
    C{"shared", "", "1: other threads were asked", &SharingRow::shared},
    C{"one_us", "us", "on one thread, median of the rounds", &SharingRow::one_us},
    C{"all_us", "us", "on all threads", &SharingRow::all_us},
    C{"ratio", "", "of all_us to one_us, median of the rounds", &SharingRow::ratio},
    C{"ratio_lo", "", "95 % interval", &SharingRow::ratio_lo},
    C{"ratio_hi", "", "", &SharingRow::ratio_hi},
};

culling::ClassMask class_of(ObjectKind kind) { return static_cast<culling::ClassMask>(1U << static_cast<int>(kind)); }

/// From the city's edge over all of it, with one side of the view level at that height.
View along_the_roofs(const City& city, double degrees) {
  const Vec3d eye(city.bounds.min.x, culling::center(city.bounds).y, kRoofs);
  View view = culling::look(eye, Vec3d(1, 0, 0), Vec3d(0, 0, 1), 1, 1);
  const double t = std::tan(degrees / 360 * std::numbers::pi);
  view.tan_left = -t, view.tan_right = t, view.tan_bottom = 0, view.tan_top = 1;
  return view;
}

/// Both ways of one query, side by side.
class Pair {
 public:
  Pair(const culling::BqrTree& tree, const SharingView& asked)
      : tree_(tree), asked_(asked), planes_(make_planes(tree, make_frustum(asked.view))), answer_(tree) {}

  void round(bool all_first, double rest_ms) {
    for (const bool all : {all_first, !all_first}) {
      std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(rest_ms));
      (all ? all_us_ : one_us_).push_back(time(all));
    }
  }

  SharingRow row() const {
    std::vector<double> ratios;
    for (std::size_t i = 1; i < one_us_.size(); ++i) ratios.push_back(all_us_[i] / one_us_[i]);  // the first makes room
    const apps::Interval interval = apps::median_interval(ratios);
    return {tree_.objects(),
            asked_.what,
            nodes_,
            crew_.members.empty() ? 0U : 1U,
            apps::median(one_us_),
            apps::median(all_us_),
            apps::median_ratio(ratios),
            interval.low,
            interval.high};
  }

 private:
  double time(bool all) {
    const auto start = apps::Clock::now();
    const culling::CullStats stats = all ? cull_parallel(tree_, planes_, crew_, answer_, asked_.options)
                                         : cull(tree_, planes_, answer_, asked_.options);
    nodes_ = stats.nodes;
    return apps::us_since(start);
  }

  const culling::BqrTree& tree_;
  const SharingView& asked_;
  culling::Planes planes_;
  culling::Answer answer_;
  culling::Crew crew_;
  std::uint64_t nodes_ = 0;
  std::vector<double> one_us_, all_us_;
};

}  // namespace

std::vector<SharingView> sharing_views(const Growth& growth, const City& city) {
  constexpr double kNoFar = std::numeric_limits<double>::infinity();
  return {{"the flight's middle", baselines::flight(city, kNoFar, 0.5), {}},
          {"along the roofs, 4 degrees", along_the_roofs(city, 4), {}},
          {"along the roofs, 16 degrees", along_the_roofs(city, 16), {}},
          {"along the roofs, 64 degrees", along_the_roofs(city, 64), {}},
          {"trees alone, all in view", growth_views(growth, city, 1).front(), {.classes = class_of(ObjectKind::tree)}}};
}

culling::BqrTree tree_with_classes(const City& city) {
  std::vector<culling::ClassMask> classes;
  classes.reserve(city.kinds.size());
  for (const ObjectKind kind : city.kinds) classes.push_back(class_of(kind));
  return build_bqr_tree(city.blocks, {city.first, city.boxes, classes});
}

SharingRun run_sharing(const SharingOptions& options, const std::function<void(double)>& progress) {
  SharingRun run{options, {}};
  std::mt19937_64 dice(options.seed);
  double done = 0;
  for (const std::string& name : options.cases) {
    const Growth& growth = *find_growth(name);
    if (fits_memory(growth)) {
      const City city = baselines::make_city(growth.objects, options.seed);
      const culling::BqrTree tree = tree_with_classes(city);
      for (const SharingView& view : sharing_views(growth, city)) {
        Pair pair(tree, view);
        for (int i = 0; i <= options.rounds; ++i) pair.round(dice() % 2 == 0, options.rest_ms);
        run.rows.push_back(pair.row());
      }
    }
    progress(++done / static_cast<double>(options.cases.size()));
  }
  return run;
}

void write_sharing(const std::filesystem::path& folder, const SharingRun& run) {
  files::write_whole(folder / "sharing.csv", apps::to_csv<SharingRow>(run.rows, kColumns));
}

std::string sharing_columns_md() { return "\n## sharing.csv\n" + explain<SharingRow>(kColumns); }

std::string sharing_md(const SharingRun& run) {
  std::vector<std::vector<std::string>> cells{
      {"objects", "view", "nodes visited", "shared", "one thread us", "all threads us", "all / one"}};
  for (const SharingRow& r : run.rows)
    cells.push_back(
        {apps::grouped(static_cast<double>(r.objects)), r.view, apps::grouped(static_cast<double>(r.nodes)),
         r.shared != 0 ? "yes" : "no", apps::digits3(r.one_us), apps::digits3(r.all_us),
         apps::digits3(r.ratio) + " [" + apps::digits3(r.ratio_lo) + ", " + apps::digits3(r.ratio_hi) + "]"});
  return "### One query on all threads\nFrom where " + std::to_string(culling::kSharedAbove) +
         " nodes wait to be visited, other threads are asked, which sleep until then: " +
         apps::digits3(run.options.rest_ms) + " ms pass before each query, as in a frame. " +
         std::to_string(tbb::this_task_arena::max_concurrency()) + " threads, " + std::to_string(run.options.rounds) +
         " rounds, in an order that chance decides.\n\n" + apps::md_table(cells);
}

}  // namespace manzana::culling_benchmark

#include "apps/culling_benchmark/semantics.h"

#include <array>
#include <random>

#include "apps/common/clock.h"
#include "apps/common/csv.h"
#include "apps/common/markdown.h"
#include "apps/common/statistics.h"
#include "culling/baselines/cases.h"
#include "files/whole_file.h"
#include "scenegraph/scene.h"

namespace manzana::culling_benchmark {
namespace {

using baselines::City;
using baselines::ObjectKind;
using culling::Answer;
using culling::BqrTree;
using culling::ClassMask;

using C = apps::Column<SemanticsRow>;
constexpr std::array kColumns{
    C{"objects", "", "in the city", &SemanticsRow::objects},
    C{"asked", "", "for which classes", &SemanticsRow::asked},
    C{"share", "", "of the city's objects that are of these classes", &SemanticsRow::share},
    C{"in_nodes", "", "visited a frame, filtered in the traversal", &SemanticsRow::in_nodes},
    C{"after_nodes", "", "the same, filtered after it", &SemanticsRow::after_nodes},
    C{"in_packets", "", "of 32 objects, tested a frame, filtered in the traversal", &SemanticsRow::in_packets},
    C{"after_packets", "", "the same, filtered after it", &SemanticsRow::after_packets},
    C{"in_us", "us", "median over the rounds of the medians over a flight", &SemanticsRow::in_us},
    C{"after_us", "us", "the same", &SemanticsRow::after_us},
    C{"ratio", "", "of in_us to after_us, median of the rounds", &SemanticsRow::ratio},
    C{"ratio_lo", "", "95 % interval", &SemanticsRow::ratio_lo},
    C{"ratio_hi", "", "", &SemanticsRow::ratio_hi},
};

constexpr std::array<std::string_view, 5> kAsked{"tree", "building", "building20", "conifer", "building40"};

/// A query in both ways, over a flight.
class Pair {
 public:
  using Way = std::function<culling::CullStats(const culling::FrustumD&)>;
  Pair(const std::vector<culling::FrustumD>& flight, Way in, Way after)
      : flight_(flight), in_(std::move(in)), after_(std::move(after)) {}

  void round(bool in_first) {
    for (const bool in : {in_first, !in_first}) (in ? in_us_ : after_us_).push_back(fly(in));
  }

  SemanticsRow row() const {
    std::vector<double> ratios;
    for (std::size_t i = 1; i < in_us_.size(); ++i) ratios.push_back(in_us_[i] / after_us_[i]);  // the first warms up
    const apps::Interval interval = apps::median_interval(ratios);
    const auto frames = static_cast<double>(flight_.size());
    SemanticsRow row;
    row.in_nodes = in_work_.nodes / frames;
    row.after_nodes = after_work_.nodes / frames;
    row.in_packets = in_work_.packets / frames;
    row.after_packets = after_work_.packets / frames;
    row.in_us = apps::median(in_us_);
    row.after_us = apps::median(after_us_);
    row.ratio = apps::median_ratio(ratios);
    row.ratio_lo = interval.low;
    row.ratio_hi = interval.high;
    return row;
  }

 private:
  double fly(bool in) {
    std::vector<double> us;
    culling::CullStats& work = in ? in_work_ : after_work_;
    work = {};
    for (const culling::FrustumD& frustum : flight_) {
      const auto start = apps::Clock::now();
      const culling::CullStats stats = (in ? in_ : after_)(frustum);
      us.push_back(apps::us_since(start));
      work.nodes += stats.nodes;
      work.packets += stats.packets;
    }
    return apps::median(std::move(us));
  }

  const std::vector<culling::FrustumD>& flight_;
  Way in_, after_;
  culling::CullStats in_work_, after_work_;
  std::vector<double> in_us_, after_us_;
};

/// One city, with everything that is asked of it.
class CityRun {
 public:
  CityRun(std::uint32_t objects, const SemanticsOptions& options)
      : city_(baselines::make_city(objects, options.seed)), classes_(classes_of(city_)), options_(options) {
    with_ = build_bqr_tree(city_.blocks, {city_.first, city_.boxes, classes_});
    without_ = build_bqr_tree(city_.blocks, {city_.first, city_.boxes, {}});
    for (int i = 0; i < options.frames; ++i)
      flight_.push_back(
          make_frustum(baselines::flight(city_, std::numeric_limits<double>::infinity(), i / (options.frames - 1.0))));
  }

  void run(std::mt19937_64& dice, std::vector<SemanticsRow>& rows) {
    rows.push_back(measured("all; with classes / without", 1, dice, plain(with_), plain(without_)));
    for (const std::string_view name : kAsked) {
      const ClassMask wanted = class_named(name).value();
      std::size_t of = 0;
      for (const ClassMask c : classes_) of += (c & wanted) != 0 ? 1 : 0;
      rows.push_back(measured(std::string(name), static_cast<double>(of) / city_.objects(), dice, filtered(wanted),
                              filtered_after(wanted)));
    }
  }

 private:
  SemanticsRow measured(std::string what, double share, std::mt19937_64& dice, Pair::Way in, Pair::Way after) const {
    Pair pair(flight_, std::move(in), std::move(after));
    for (int i = 0; i <= options_.rounds; ++i) pair.round(dice() % 2 == 0);
    SemanticsRow row = pair.row();
    row.objects = city_.objects();
    row.asked = std::move(what);
    row.share = share;
    return row;
  }

  Pair::Way plain(const BqrTree& tree) {
    return [this, &tree](const culling::FrustumD& frustum) { return cull(tree, make_planes(tree, frustum), answer_); };
  }
  Pair::Way filtered(ClassMask wanted) {
    return [this, wanted](const culling::FrustumD& frustum) {
      return cull(with_, make_planes(with_, frustum), answer_, {.classes = wanted});
    };
  }
  Pair::Way filtered_after(ClassMask wanted) {
    return [this, wanted](const culling::FrustumD& frustum) {
      const culling::CullStats stats = cull(with_, make_planes(with_, frustum), answer_);
      filter_after(with_, answer_, wanted, runs_);
      return stats;
    };
  }

  City city_;
  std::vector<ClassMask> classes_;
  const SemanticsOptions& options_;
  BqrTree with_, without_;
  std::vector<culling::FrustumD> flight_;
  Answer answer_;
  std::vector<culling::ObjectRun> runs_;
};

}  // namespace

std::vector<ClassMask> classes_of(const City& city) {
  std::vector<ClassMask> classes;
  for (std::uint32_t i = 0; i < city.objects(); ++i) {
    const double height = city.boxes[i].max.z - city.boxes[i].min.z;
    const bool conifer = i % 4 == 0;  // the cities of the benchmark have trees of one kind
    const ClassMask tree = tree_class(conifer ? PlantKind::conifer : PlantKind::broadleaf, height);
    switch (city.kinds[i]) {
      case ObjectKind::building:
        classes.push_back(building_class(height));
        break;
      case ObjectKind::tree:
        classes.push_back(tree);
        break;
      default:
        classes.push_back(city.kinds[i] == ObjectKind::car ? kCar : kSurface);
    }
  }
  return classes;
}

void filter_after(const BqrTree& tree, const Answer& all, ClassMask classes, std::vector<culling::ObjectRun>& out) {
  out.clear();
  for (const culling::ObjectRun& run : all.objects())
    for (std::uint32_t i = run.first; i < run.last; ++i) {
      if ((tree.classes[i] & classes) == 0) continue;
      if (!out.empty() && out.back().last == i)
        ++out.back().last;
      else
        out.push_back({i, i + 1});
    }
}

SemanticsRun run_semantics(const SemanticsOptions& options, const std::function<void(double)>& progress) {
  SemanticsRun run{options, {}};
  std::mt19937_64 dice(options.seed);
  double done = 0;
  for (const std::uint32_t objects : options.cities) {
    CityRun(objects, options).run(dice, run.rows);
    progress(++done / static_cast<double>(options.cities.size()));
  }
  return run;
}

void write_semantics(const std::filesystem::path& folder, const SemanticsRun& run) {
  files::write_whole(folder / "semantics.csv", apps::to_csv<SemanticsRow>(run.rows, kColumns));
}

std::string semantics_columns_md() { return "\n## semantics.csv\n" + explain<SemanticsRow>(kColumns); }

std::string semantics_md(const SemanticsRun& run) {
  std::vector<std::vector<std::string>> cells{{"objects", "asked", "share", "nodes in / after", "packets in / after",
                                               "in the traversal us", "after it us", "in / after"}};
  for (const SemanticsRow& r : run.rows)
    cells.push_back(
        {apps::grouped(static_cast<double>(r.objects)), r.asked, apps::digits3(r.share),
         apps::digits3(r.in_nodes) + " / " + apps::digits3(r.after_nodes),
         apps::digits3(r.in_packets) + " / " + apps::digits3(r.after_packets), apps::digits3(r.in_us),
         apps::digits3(r.after_us),
         apps::digits3(r.ratio) + " [" + apps::digits3(r.ratio_lo) + ", " + apps::digits3(r.ratio_hi) + "]"});
  return "### Classes: filtered in the traversal and after it\nWhat is asked for some classes only "
         "(scenegraph/classes.h), by the classes that nodes unite of all below; and as for everything, each object "
         "that "
         "is found looked at after it. First of each city, what having classes costs who asks for everything. " +
         std::to_string(run.options.frames) + " frames of the flight without a far plane, " +
         std::to_string(run.options.rounds) + " rounds, in an order that chance decides.\n\n" + apps::md_table(cells);
}

}  // namespace manzana::culling_benchmark

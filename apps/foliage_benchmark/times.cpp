#include "apps/foliage_benchmark/times.h"

#include <thread>

#include "apps/common/child.h"
#include "apps/common/progress_bar.h"
#include "apps/common/record.h"
#include "apps/common/run_facts.h"
#include "gl/context.h"

namespace manzana::foliage_benchmark {
namespace {

/// A line of times.csv.
struct FileRow : TimeRow, apps::RunFacts, apps::Calm {};
using R = FileRow;
using C = apps::Column<R>;

const std::vector<C> kOwnColumns{
    {"table", "", "the source, and which of its tables", &R::table},
    {"plant", "", "", &R::plant},
    {"way", "", "what is measured", &R::way},
    {"reference", "", "what it is compared with", &R::reference},
    {"trees", "", "drawn or extracted", &R::trees},
    {"error_px", "pixels", "that was tolerated; what neighbours hide: up to 3 times as much", &R::error_px},
    {"primitives", "", "triangles and points drawn", &R::primitives},
    {"reference_primitives", "", "by the reference", &R::reference_primitives},
    {"bark", "quads", "of these, two triangles each", &R::bark},
    {"leaves", "quads", "of these, two triangles each", &R::leaves},
    {"lines", "", "of these, two triangles each", &R::lines},
    {"points", "", "of these", &R::points},
    {"ms", "ms", "median", &R::ms},
    {"ms_99", "ms", "99th percentile of frames along a path", &R::ms_99},
    {"reference_ms", "ms", "median", &R::reference_ms},
    {"ratio", "", "median of reference_ms over ms of a pair", &R::ratio},
    {"ratio_lo", "", "of its 95 % interval, within one process", &R::ratio_lo},
    {"ratio_hi", "", "", &R::ratio_hi},
    {"pairs", "", "that were timed", &R::pairs},
    {"covered_px", "pixels", "that plants cover, however little", &R::covered_px},
    {"overdraw", "", "samples drawn, hidden ones too, over those covered", &R::overdraw},
    {"cover", "", "over all detail's, finely sampled", &R::cover},
    {"colour", "", "difference of mean colours, linear", &R::colour},
    {"ssim", "", "against all detail, finely sampled", &R::ssim},
    {"gmsd", "", "against all detail, finely sampled", &R::gmsd},
    {"bytes", "bytes", "of memory", &R::bytes},
    {"source_value", "", "what stands in the source", &R::source_value}};

std::span<const C> columns() {
  static const auto all = apps::joined<R>({apps::run_columns<R>(), kOwnColumns, apps::calm_columns<R>()});
  return all;
}

bool same_key(const TimeRow& a, const TimeRow& b) {
  return a.table == b.table && a.plant == b.plant && a.way == b.way && a.reference == b.reference;
}

/// A software renderer draws with all cores.
int threads() { return gl::software_renderer() ? static_cast<int>(std::thread::hardware_concurrency()) : 1; }

void add_all(const Effort& effort, std::span<const foliage::PreparedPlant> plants, Times& times) {
  add_gumbau(effort, plants, times);
  add_deussen(effort, plants, times);
  add_gadbem(effort, plants, times);
  add_forests(effort, plants, times);
  add_zhang(effort, plants, times);
  add_extraction(effort, plants, times);
}

/// Measures rows as they are asked for, and keeps them.
class Recorder {
 public:
  Recorder(const Effort& effort, std::size_t expected)
      : quick_(effort.quick),
        expected_(expected),
        facts_(apps::run_facts(effort.quick ? "quick" : "full")),
        record_(effort.out / "times.csv", columns(), [&](const FileRow& row) { return same_run(row, facts_); }),
        bar_(stderr) {
    for (const FileRow& row : record_.rows()) undisturbed_.note_calibration(row.calibration_ms);
  }

  void take(TimeRow& row, const Times::Measure& measure) {
    bar_.show("tables", static_cast<double>(done_++) / static_cast<double>(expected_),
              row.table + ": " + row.plant + ", " + row.way);
    const FileRow* known = record_.find([&](const FileRow& r) { return same_key(r, row); });
    if (known == nullptr) {
      record_.keep(measured(row, measure));
      known = &record_.rows().back();
    }
    dirty_ += known->dirty;
    row = *known;
  }
  std::uint64_t dirty() const { return dirty_; }

 private:
  FileRow measured(const TimeRow& key, const Times::Measure& measure) {
    apps::throw_if_interrupted();
    FileRow row;
    const auto again = [&](double seconds) { return !quick_ && row.ms && seconds < kLongestRepeated; };
    static_cast<apps::Calm&>(row) = undisturbed_.measure(
        threads(),
        [&](std::uint64_t) {
          static_cast<TimeRow&>(row) = key;
          measure(row);
        },
        again);
    static_cast<apps::RunFacts&>(row) = apps::run_facts(facts_.mode);
    if (!row.ms) row.dirty = 0;  // pictures and counts are what they are
    return row;
  }

  static constexpr double kLongestRepeated = 60;  // seconds
  bool quick_;
  std::size_t expected_, done_ = 0;
  apps::RunFacts facts_;
  apps::Record<FileRow> record_;
  apps::Undisturbed undisturbed_;
  apps::ProgressBar bar_;
  std::uint64_t dirty_ = 0;
};

}  // namespace

void set_times(const PairTimes& times, TimeRow& row) {
  row.ms = times.ms;
  row.reference_ms = times.reference_ms;
  row.ratio = times.ratio;
  row.ratio_lo = times.ratio_lo;
  row.ratio_hi = times.ratio_hi;
  row.pairs = times.pairs;
}

void set_shown(const foliage::Shown& shown, TimeRow& row) {
  row.bark = shown.bark;
  row.leaves = shown.leaves;
  row.lines = shown.lines;
  row.points = shown.points;
  row.primitives = primitives_of(shown);
}

void set_errors(const ImageError& error, TimeRow& row) {
  row.cover = error.cover;
  row.colour = error.colour;
  row.ssim = error.ssim;
  row.gmsd = error.gmsd;
}

Times measure_rows(const Effort& effort, const std::function<void(Times&)>& add) {
  Times counted;
  counted.take = [](TimeRow&, const Times::Measure&) {};
  counted.draw = [](const std::function<void()>&) {};
  add(counted);
  Recorder recorder(effort, counted.rows.size());
  Times times;
  times.take = [&](TimeRow& row, const Times::Measure& measure) { recorder.take(row, measure); };
  add(times);
  times.dirty = recorder.dirty();
  times.take = {};  // the recorder is gone
  return times;
}

Times measure_times(const Effort& effort, std::span<const foliage::PreparedPlant> plants) {
  return measure_rows(effort, [&](Times& times) { add_all(effort, plants, times); });
}

std::string explain_times() { return apps::explain(columns()); }

}  // namespace manzana::foliage_benchmark

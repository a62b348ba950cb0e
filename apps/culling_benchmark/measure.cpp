#include "apps/culling_benchmark/measure.h"

#include <algorithm>
#include <cctype>
#include <chrono>

#include "apps/common/conditions.h"
#include "apps/common/statistics.h"
#include "apps/culling_benchmark/frame_table.h"
#include "apps/culling_benchmark/rules.h"
#include "apps/culling_benchmark/stock.h"
#include "apps/culling_benchmark/truth.h"
#include "culling/hash.h"
#include "files/whole_file.h"

namespace manzana::culling_benchmark {
namespace {

using baselines::Peer;
using baselines::PeerInfo;

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A case's workload with what is exactly in view.
struct Given {
  Workload work;
  Truth truth;
};

/// With a copy for each thread, the first of them of that number.
Contender contender(Stock& stock, const PeerInfo& info, const Workload& work, std::size_t first) {
  Contender all{stock.get(info, work.city, first).peer.get(), {}, &work.frusta};
  for (std::size_t more = 1; more < static_cast<std::size_t>(work.info.threads); ++more)
    all.company.push_back(stock.get(info, work.city, first + more).peer.get());
  return all;
}

std::vector<const PeerInfo*> missing(const Options& options, const std::string& name, int process,
                                     std::span<const RunRow> finished) {
  std::vector<const PeerInfo*> todo;
  for (const std::string& slug : peers_for(options, name))
    if (can_measure(name, slug) && !is_finished(finished, expected_row(options, name, slug, process)))
      todo.push_back(peer_info(slug));
  return todo;
}

/// What is missing of a case gets its part of the case's time.
double seconds_for(const Options& options, const std::string& name, int process, std::span<const RunRow> finished) {
  return case_seconds(options, name) * static_cast<double>(missing(options, name, process, finished).size()) /
         static_cast<double>(peers_for(options, name).size());
}

void set_times(RunRow& row, const PairTimes& times) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < times.peer_us.size(); ++i) ratios.push_back(times.peer_us[i] / times.bqr_us[i]);
  const apps::Interval interval = apps::median_interval(ratios);
  row.median_us = apps::median(times.peer_us);
  row.bqr_us = apps::median(times.bqr_us);
  row.ratio = apps::median_ratio(ratios);
  row.ratio_lo = interval.low;
  row.ratio_hi = interval.high;
}

void set_counts(RunRow& row, const Counts& counts) {
  row.accepted = counts.accepted;
  row.exact = counts.exact;
  row.missed = counts.missed;
  row.triangles = counts.triangles;
}

/// Lives for one process.
class Measurer {
 public:
  Measurer(const Options& options, std::span<const RunRow> finished, const Tell& tell)
      : options_(options), finished_(finished), tell_(tell), rules_(rules_of(options)) {
    for (const RunRow& row : finished) undisturbed_.note_calibration(row.calibration_ms);
  }

  void run() {
    end_ = seconds_now() + expected_seconds(options_, options_.process, finished_);
    case_end_ = seconds_now();
    for (const std::string& name : cases_of(options_)) {
      case_end_ += seconds_for(options_, name, options_.process, finished_);
      measure_case(name);
    }
  }

 private:
  Given prepare(const std::string& name, int frames) {
    Workload work = make_workload(name, options_.seed, frames, cities_);
    const double before = seconds_now();
    Truth truth = kept_truth(work, truth_folder(options_));
    if (!options_.quick) delay(seconds_now() - before);  // what the first process does for all is not its rows' loss
    return {std::move(work), std::move(truth)};
  }

  void delay(double seconds) {
    case_end_ += seconds;
    end_ += seconds;
  }

  void measure_case(const std::string& name) {
    const auto todo = missing(options_, name, options_.process, finished_);
    if (todo.empty()) return;
    tell(name, 0);
    const Given given = prepare(name, frames_of(options_, name));
    const PeerInfo& bqr = *peer_info("bqr");
    bqr_ = contender(stock_, bqr, given.work, 0);
    bqr_us_ = query_times(check(*bqr_.peer, given.work, given.truth));
    for (std::size_t i = 0; i < todo.size(); ++i) {
      row_start_ = seconds_now();
      row_seconds_ = (case_end_ - row_start_) / static_cast<double>(todo.size() - i);
      tell_.row(todo[i]->slug == kSmallerCity ? measure_smaller(*todo[i], name)
                                              : measure_row(name, *todo[i], given, stock_));
      tell(name, static_cast<double>(i + 1) / static_cast<double>(todo.size()));
    }
  }

  void tell(const std::string& name, double fraction) const {
    const std::string process = rules_.processes > 1 ? std::to_string(options_.process) + ": " : "";
    tell_.progress(process + name, fraction, std::max(end_ - seconds_now(), 0.0));
  }

  /// The same flight through the smaller city: as many frames.
  RunRow measure_smaller(const PeerInfo& info, const std::string& name) {
    Stock stock;
    return measure_row(name, info, prepare(kSmallerCase, frames_of(options_, name)), stock);
  }

  RunRow measure_row(const std::string& name, const PeerInfo& info, const Given& given, Stock& stock) {
    RunRow row = expected_row(options_, name, info.slug, options_.process);
    const Workload& work = given.work;
    row.grain = info.grain == baselines::Grain::block ? "block" : "object";
    row.objects = work.city->objects();
    row.blocks = work.city->blocks.size();
    const std::size_t first = info.slug == "bqr" ? static_cast<std::size_t>(work.info.threads) : 0;  // another bqr
    const Contender peer = contender(stock, info, work, first);
    row.build_ms = stock.get(info, work.city, first).build_ms;
    row.bytes = peer.peer->bytes();
    const std::vector<Counts> counts = check(*peer.peer, work, given.truth);
    set_counts(row, sum(counts));
    time_until_clean(row, peer, work.info, counts);
    row.date = apps::now_utc();
    return row;
  }

  Limits limits_now() const {
    Limits limits = rules_.limits;
    limits.seconds = row_start_ + row_seconds_ - seconds_now();
    return limits;
  }

  void time_until_clean(RunRow& row, const Contender& peer, const CaseInfo& info, const std::vector<Counts>& counts) {
    const Plan plan = plan_pairs(limits_now(), bqr_us_, query_times(counts), info.cold ? stream_us() : 0);
    row.timed_frames = plan.frames.size();
    row.pairs = plan.pairs;
    PairTimes times;
    static_cast<apps::Calm&>(row) = undisturbed_.measure(
        info.threads,
        [&](std::uint64_t attempt) {
          times = time_pairs(bqr_, peer, info.cold, plan, hash_bits(row.seed, row.process * 64 + attempt));
        },
        [&](double seconds) { return time_for(seconds); });
    set_times(row, times);
    if (row.process == 1) write_frames(row, plan, times, counts);
  }

  bool time_for(double seconds) const { return seconds_now() + seconds < row_start_ + row_seconds_; }

  void write_frames(const RunRow& row, const Plan& plan, const PairTimes& times, const std::vector<Counts>& counts) {
    const auto folder = options_.out / "frames";
    files::make_folder(folder);
    files::write_whole(folder / (file_name(row.case_name) + "_" + row.peer + ".csv"),
                       to_csv(frame_table(counts, plan, times)));
  }

  const Options& options_;
  std::span<const RunRow> finished_;
  const Tell& tell_;
  Rules rules_;
  Cities cities_;
  Stock stock_;
  double end_ = 0, case_end_ = 0, row_start_ = 0, row_seconds_ = 0;
  apps::Undisturbed undisturbed_;
  Contender bqr_;               // of the case
  std::vector<double> bqr_us_;  // of each frame, once
};

}  // namespace

void measure(const Options& options, std::span<const RunRow> finished, const Tell& tell) {
  Measurer(options, finished, tell).run();
}

double expected_seconds(const Options& options, int process, std::span<const RunRow> finished) {
  double seconds = 0;
  for (const std::string& name : cases_of(options)) seconds += seconds_for(options, name, process, finished);
  return seconds;
}

RunRow expected_row(const Options& options, const std::string& case_name, std::string_view peer, int process) {
  RunRow row;
  static_cast<apps::RunFacts&>(row) = apps::run_facts(rules_of(options).mode);
  row.scene = scene_state(case_name);
  row.case_name = case_name;
  row.peer = peer;
  row.seed = options.seed;
  row.process = static_cast<std::uint64_t>(process);
  row.frames = static_cast<std::uint64_t>(frames_of(options, case_name));
  return row;
}

bool is_finished(std::span<const RunRow> finished, const RunRow& expected) {
  return std::any_of(finished.begin(), finished.end(),
                     [&](const RunRow& row) { return same_measurement(row, expected); });
}

std::string file_name(const std::string& case_name) {
  std::string name;
  for (const char c : std::filesystem::path(case_name).filename().string())
    name += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' ? c : '_';
  return name;
}

}  // namespace manzana::culling_benchmark

#include "apps/culling_benchmark/measure.h"

#include <algorithm>
#include <cctype>
#include <chrono>

#include "apps/common/whole_file.h"
#include "apps/culling_benchmark/conditions.h"
#include "apps/culling_benchmark/frame_table.h"
#include "apps/culling_benchmark/machine.h"
#include "apps/culling_benchmark/rules.h"
#include "apps/culling_benchmark/statistics.h"
#include "apps/culling_benchmark/truth.h"
#include "culling/hash.h"

namespace manzana::culling_benchmark {
namespace {

using baselines::Peer;
using baselines::PeerInfo;

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Built {
  std::unique_ptr<Peer> peer;
  double ms = 0;
  std::vector<std::unique_ptr<Peer>> more;  // one for each other thread
  Contender contender() const {
    Contender all{peer.get(), {}};
    for (const auto& one : more) all.company.push_back(one.get());
    return all;
  }
};
Built build(const PeerInfo& info, const Workload& work) {
  const double start = seconds_now();
  Built built{info.make(*work.city), 0, {}};
  built.ms = (seconds_now() - start) * 1e3;
  for (int thread = 1; thread < work.info.threads; ++thread) built.more.push_back(info.make(*work.city));
  return built;
}

void set_times(RunRow& row, const PairTimes& times, const Conditions& during) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < times.peer_us.size(); ++i) ratios.push_back(times.peer_us[i] / times.bqr_us[i]);
  const Interval interval = median_interval(ratios);
  row.median_us = median(times.peer_us);
  row.bqr_us = median(times.bqr_us);
  row.ratio = median_ratio(ratios);
  row.ratio_lo = interval.low;
  row.ratio_hi = interval.high;
  row.calibration_ms = during.calibration_ms;
  row.others_cores = during.others_cores;
  row.steal = during.steal;
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
    for (const RunRow& row : finished) note_calibration(row.calibration_ms);
    for (int i = 0; i < 5; ++i) note_calibration(calibrate_ms());
  }

  void run() {
    const auto cases = cases_of(options_);
    double shares = 0, used = 0;
    for (const std::string& name : cases) shares += share_of(name);
    for (const std::string& name : cases) {
      used += share_of(name);
      case_end_ = start_ + rules_.seconds * used / shares;
      measure_case(name);
    }
  }

 private:
  void note_calibration(double ms) { best_calibration_ms_ = std::min(best_calibration_ms_, ms); }

  std::vector<const PeerInfo*> missing(const std::string& name) const {
    std::vector<const PeerInfo*> todo;
    for (const std::string& slug : peers_for(options_, name)) {
      const RunRow expected = expected_row(options_, name, slug, options_.process);
      if (can_measure(name, slug) && !is_finished(finished_, expected)) todo.push_back(peer_info(slug));
    }
    return todo;
  }

  void measure_case(const std::string& name) {
    const auto todo = missing(name);
    if (todo.empty()) return;
    const std::string stage = rules_.processes > 1 ? std::to_string(options_.process) + ": " + name : name;
    tell_.progress(stage, 0);
    const Workload work = make_workload(name, options_.seed, frames_of(options_, name), cities_);
    const Truth truth = find_truth(work);
    const Built bqr = build(*peer_info("bqr"), work);
    bqr_us_ = query_times(check(*bqr.peer, work, truth));
    for (std::size_t i = 0; i < todo.size(); ++i) {
      row_start_ = seconds_now();
      row_seconds_ = (case_end_ - row_start_) / static_cast<double>(todo.size() - i);
      tell_.row(measure_row(*todo[i], work, truth, bqr));
      tell_.progress(stage, static_cast<double>(i + 1) / static_cast<double>(todo.size()));
    }
  }

  RunRow measure_row(const PeerInfo& info, const Workload& work, const Truth& truth, const Built& bqr) {
    RunRow row = expected_row(options_, work.info.name, info.slug, options_.process);
    row.grain = info.grain == baselines::Grain::block ? "block" : "object";
    row.objects = work.city->objects();
    row.blocks = work.city->blocks.size();
    const Built built = build(info, work);
    row.build_ms = built.ms;
    row.bytes = built.peer->bytes();
    const std::vector<Counts> counts = check(*built.peer, work, truth);
    set_counts(row, sum(counts));
    time_until_clean(row, bqr.contender(), built.contender(), work, counts);
    row.date = now_utc();
    return row;
  }

  Limits limits_now(const std::string& case_name) const {
    Limits limits = rules_.limits;
    limits.seconds = rules_.seconds > 0 ? row_start_ + row_seconds_ - seconds_now() : row_seconds(case_name);
    return limits;
  }

  void time_until_clean(RunRow& row, const Contender& bqr, const Contender& peer, const Workload& work,
                        const std::vector<Counts>& counts) {
    const Plan plan =
        plan_pairs(limits_now(work.info.name), bqr_us_, query_times(counts), work.info.cold ? stream_us() : 0);
    row.timed_frames = plan.frames.size();
    row.pairs = plan.pairs;
    for (row.attempts = 1;; ++row.attempts) {
      const double start = seconds_now();
      const Watch watch;
      const PairTimes times = time_pairs(bqr, peer, work, plan, hash_bits(row.seed, row.process * 64 + row.attempts));
      const Conditions during = watch.stop();
      note_calibration(during.calibration_ms);
      set_times(row, times, during);
      row.dirty = disturbed(during, best_calibration_ms_, work.info.threads) ? 1 : 0;
      if (row.dirty == 0 || row.attempts == kAttempts || !time_for(seconds_now() - start)) {
        if (row.process == 1) write_frames(row, plan, times, counts);
        return;
      }
    }
  }

  bool time_for(double seconds) const {
    return rules_.seconds <= 0 || seconds_now() + seconds < row_start_ + row_seconds_;
  }

  void write_frames(const RunRow& row, const Plan& plan, const PairTimes& times, const std::vector<Counts>& counts) {
    const auto folder = options_.out / "frames";
    apps::make_folder(folder);
    apps::write_whole(folder / (file_name(row.case_name) + "_" + row.peer + ".csv"),
                      to_csv(frame_table(counts, plan, times)));
  }

  const Options& options_;
  std::span<const RunRow> finished_;
  const Tell& tell_;
  Rules rules_;
  Cities cities_;
  double start_ = seconds_now(), case_end_ = 0, row_start_ = 0, row_seconds_ = 0;
  double best_calibration_ms_ = 1e9;
  std::vector<double> bqr_us_;  // of each frame, once
};

}  // namespace

void measure(const Options& options, std::span<const RunRow> finished, const Tell& tell) {
  Measurer(options, finished, tell).run();
}

RunRow expected_row(const Options& options, const std::string& case_name, std::string_view peer, int process) {
  const Machine& machine = this_machine();
  RunRow row;
  row.commit = machine.commit;
  row.machine = short_name(machine);
  row.mode = rules_of(options).mode;
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

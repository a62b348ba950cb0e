#include "apps/culling_benchmark/timing.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "apps/culling_benchmark/statistics.h"
#include "culling/hash.h"

namespace manzana::culling_benchmark {
namespace {

using baselines::Answer;
using baselines::Peer;
using Clock = std::chrono::steady_clock;

double us_since(Clock::time_point start) {
  return std::chrono::duration<double, std::micro>(Clock::now() - start).count();
}

/// More than any cache of today's processors holds for one core; read and written, so that all else is driven out.
class Stream {
 public:
  void flow() {
    for (std::uint64_t& word : words_) ++word;
  }

 private:
  std::vector<std::uint64_t> words_ = std::vector<std::uint64_t>((96 << 20) / sizeof(std::uint64_t));
};

Stream& stream() {
  static Stream only;
  return only;
}

class Rounds {
 public:
  Rounds(const Workload& work, const std::vector<std::size_t>& frames)
      : work_(work), frames_(frames), overhead_us_(clock_overhead_us()), us_(frames.size()) {}

  /// The times of one flight, valid until the next.
  const std::vector<double>& fly(Peer& peer, Answer& answer) {
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      if (work_.cold) stream().flow();
      const auto start = Clock::now();
      peer.query(work_.frusta[frames_[i]], answer);
      us_[i] = std::max(us_since(start) - overhead_us_, 1e-3);  // a nanosecond: a ratio needs more than nothing
    }
    return us_;
  }

 private:
  const Workload& work_;
  const std::vector<std::size_t>& frames_;
  double overhead_us_;
  std::vector<double> us_;
};

std::vector<std::size_t> spread(std::size_t n, std::size_t frames) {
  std::vector<std::size_t> at;
  for (std::size_t i = 0; i < n; ++i) at.push_back((2 * i + 1) * frames / (2 * n));
  return at;
}

}  // namespace

Plan plan_pairs(const Limits& limits, double frame_us, std::size_t frames) {
  const double affordable = limits.seconds * 1e6 / std::max(frame_us, 1e-3);  // frames of all pairs
  const auto at_most = [](double n, std::size_t low, std::size_t high) {
    return std::clamp(static_cast<std::size_t>(std::min(n, 1e9)), std::min(low, high), high);
  };
  const std::size_t n = at_most(affordable / static_cast<double>(limits.pairs), limits.least_frames, frames);
  const std::size_t pairs = at_most(affordable / static_cast<double>(n), limits.least_pairs, limits.pairs);
  return {spread(n, frames), pairs};
}

PairTimes time_pairs(Peer& bqr, Peer& peer, const Workload& work, const Plan& plan, std::uint64_t seed) {
  Rounds rounds(work, plan.frames);
  Answer of_bqr, of_peer;
  PairTimes times;
  std::vector<std::vector<double>> by_frame(plan.frames.size());
  const auto fly_bqr = [&] { times.bqr_us.push_back(median(rounds.fly(bqr, of_bqr))); };
  const auto fly_peer = [&] {
    const std::vector<double>& us = rounds.fly(peer, of_peer);
    times.peer_us.push_back(median(us));
    for (std::size_t i = 0; i < us.size(); ++i) by_frame[i].push_back(us[i]);
  };
  rounds.fly(bqr, of_bqr);  // grows the answers, warms what may be warm; not counted
  rounds.fly(peer, of_peer);
  for (std::size_t pair = 0; pair < plan.pairs; ++pair) {
    const bool bqr_first = hash_bits(seed, pair) % 2 == 0;
    if (bqr_first) fly_bqr();
    fly_peer();
    if (!bqr_first) fly_bqr();
  }
  for (auto& us : by_frame) times.frame_us.push_back(median(std::move(us)));
  return times;
}

double clock_overhead_us() {
  std::vector<double> us(1001);
  for (double& one : us) one = us_since(Clock::now());
  return median(std::move(us));
}

double stream_us() {
  stream().flow();
  const auto start = Clock::now();
  stream().flow();
  return us_since(start);
}

}  // namespace manzana::culling_benchmark

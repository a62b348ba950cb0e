#include "apps/culling_benchmark/timing.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <thread>

#include "apps/common/clock.h"
#include "apps/common/statistics.h"
#include "culling/hash.h"

namespace manzana::culling_benchmark {
namespace {

using baselines::Answer;
using baselines::Peer;

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

/// Flies with others while it lives.
class Company {
 public:
  Company(const Contender& contender, const std::vector<std::size_t>& frames) {
    for (Peer* peer : contender.company)
      threads_.emplace_back([this, peer, &contender, &frames] { fly(*peer, *contender.flight, frames); });
    while (under_way_ < contender.company.size()) std::this_thread::yield();
  }
  ~Company() {
    landing_ = true;
    for (std::thread& thread : threads_) thread.join();
  }
  Company(const Company&) = delete;
  Company& operator=(const Company&) = delete;

 private:
  void fly(Peer& peer, const std::vector<culling::FrustumD>& flight, const std::vector<std::size_t>& frames) {
    Answer answer;
    for (std::size_t i = 0; !landing_; i = (i + 1) % frames.size()) {
      peer.query(flight[frames[i]], answer);
      if (i == 0) ++under_way_;
    }
  }

  std::atomic<bool> landing_ = false;
  std::atomic<std::size_t> under_way_ = 0;
  std::vector<std::thread> threads_;
};

class Rounds {
 public:
  Rounds(bool cold, const Plan& plan)
      : cold_(cold),
        warm_up_(plan.warm_up),
        frames_(plan.frames),
        overhead_us_(clock_overhead_us()),
        us_(plan.frames.size()) {}

  /// The times of one flight, valid until the next.
  const std::vector<double>& fly(const Contender& contender, Answer& answer) {
    const Company company(contender, frames_);
    for (std::size_t i = 0; warm_up_ && i < frames_.size(); ++i)
      contender.peer->query((*contender.flight)[frames_[i]], answer);
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      if (cold_) stream().flow();
      const auto start = apps::Clock::now();
      contender.peer->query((*contender.flight)[frames_[i]], answer);
      us_[i] = std::max(apps::us_since(start) - overhead_us_, 1e-3);  // a nanosecond: a ratio needs more than nothing
    }
    return us_;
  }

 private:
  bool cold_, warm_up_;
  const std::vector<std::size_t>& frames_;
  double overhead_us_;
  std::vector<double> us_;
};

/// Of each value: how many are less; equal ones in their order.
std::vector<std::size_t> ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size()), rank(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = i;
  return rank;
}

std::vector<std::size_t> choose_frames(std::size_t n, const std::vector<double>& a, const std::vector<double>& b) {
  const auto rank_a = ranks(a), rank_b = ranks(b);
  std::vector<std::size_t> order(a.size()), chosen;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t k) { return rank_a[i] + rank_b[i] < rank_a[k] + rank_b[k]; });
  for (std::size_t i = 0; i < n; ++i) chosen.push_back(order[(2 * i + 1) * order.size() / (2 * n)]);
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace

Plan plan_pairs(const Limits& limits, const std::vector<double>& bqr_us, const std::vector<double>& peer_us,
                double between_us) {
  const std::size_t frames = bqr_us.size();
  const double flight_us = std::accumulate(bqr_us.begin(), bqr_us.end(), 0.0) +
                           std::accumulate(peer_us.begin(), peer_us.end(), 0.0) +
                           2 * between_us * static_cast<double>(frames);
  const double frame_us = std::max(flight_us / static_cast<double>(frames), 1e-3);
  const double seconds = std::max(limits.seconds, limits.least_seconds);
  const double affordable = seconds * 1e6 / frame_us;  // frames of all pairs together
  const auto at_most = [](double n, std::size_t low, std::size_t high) {
    return std::clamp(static_cast<std::size_t>(std::clamp(n, 0.0, 1e9)), std::min(low, high), high);
  };
  const bool warm_up = between_us == 0 && affordable < static_cast<double>(limits.pairs * frames);
  const double timed = warm_up ? affordable / 2 : affordable;
  const std::size_t n = at_most(timed / static_cast<double>(limits.pairs), limits.least_frames, frames);
  const std::size_t pairs = at_most(timed / static_cast<double>(n), limits.least_pairs, limits.pairs);
  return {choose_frames(n, bqr_us, peer_us), pairs, warm_up};
}

PairTimes time_pairs(const Contender& bqr, const Contender& peer, bool cold, const Plan& plan, std::uint64_t seed) {
  Rounds rounds(cold, plan);
  Answer of_bqr, of_peer;
  PairTimes times;
  std::vector<std::vector<double>> by_frame(plan.frames.size());
  const auto fly_bqr = [&] { times.bqr_us.push_back(apps::median(rounds.fly(bqr, of_bqr))); };
  const auto fly_peer = [&] {
    const std::vector<double>& us = rounds.fly(peer, of_peer);
    times.peer_us.push_back(apps::median(us));
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
  for (auto& us : by_frame) times.frame_us.push_back(apps::median(std::move(us)));
  return times;
}

double clock_overhead_us() {
  std::vector<double> us(1001);
  for (double& one : us) one = apps::us_since(apps::Clock::now());
  return apps::median(std::move(us));
}

double stream_us() {
  stream().flow();
  const auto start = apps::Clock::now();
  stream().flow();
  return apps::us_since(start);
}

}  // namespace manzana::culling_benchmark

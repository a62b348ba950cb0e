#include "apps/common/conditions.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <string>
#include <thread>

#include "apps/common/clock.h"

namespace manzana::apps {
namespace {

double cores() { return std::max(1U, std::thread::hardware_concurrency()); }

double seconds(const timeval& t) { return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6; }

/// user, nice, system, idle, iowait, irq, softirq, steal; seconds of all cores. Zeros where there is no /proc.
std::array<double, 8> processor_times() {
  std::array<double, 8> times{};
  std::ifstream in("/proc/stat");
  std::string cpu;
  in >> cpu;
  for (double& t : times)
    if (in >> t) t /= static_cast<double>(sysconf(_SC_CLK_TCK));
  return times;
}

volatile std::uint64_t kept;  // so that the loop is not optimised away

}  // namespace

double calibrate_ms() {
  const auto start = std::chrono::steady_clock::now();
  std::uint64_t x = 1;
  for (int i = 0; i < 2'000'000; ++i) x = x * 6364136223846793005ULL + 1442695040888963407ULL;  // a chain: no overlap
  kept = x;
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

Watch::Reading Watch::read() {
  const auto t = processor_times();
  rusage own{};
  getrusage(RUSAGE_SELF, &own);
  const auto wall = std::chrono::steady_clock::now().time_since_epoch();
  return {std::chrono::duration<double>(wall).count(), t[0] + t[1] + t[2] + t[5] + t[6],
          seconds(own.ru_utime) + seconds(own.ru_stime), t[7]};
}

Watch::Watch() : calibration_ms_(calibrate_ms()), start_(read()) {}

Conditions Watch::stop() const {
  const Reading end = read();
  const double wall = std::max(end.wall_s - start_.wall_s, 1e-3);
  const double own = (end.own_s - start_.own_s) / wall;
  const double stolen = (end.steal_s - start_.steal_s) / wall;
  Conditions during;
  during.others_cores = std::max(0.0, (end.busy_s - start_.busy_s) / wall - own);
  during.free_cores = cores() - during.others_cores - stolen;
  during.steal = stolen / cores();
  during.calibration_ms = std::max(calibration_ms_, calibrate_ms());
  return during;
}

bool disturbed(const Conditions& conditions, double best_calibration_ms, int threads) {
  const double needed = cores() > threads ? threads + 0.25 : 0.95 * std::min<double>(threads, cores());
  return conditions.calibration_ms > 1.1 * best_calibration_ms || conditions.free_cores < needed ||
         conditions.steal > 0.02;
}

Undisturbed::Undisturbed() {
  for (int i = 0; i < 5; ++i) note_calibration(calibrate_ms());
}

void Undisturbed::note_calibration(double ms) { best_calibration_ms_ = std::min(best_calibration_ms_, ms); }

Calm Undisturbed::measure(int threads, const std::function<void(std::uint64_t)>& measure,
                          const std::function<bool(double)>& again) {
  Calm calm;
  for (calm.attempts = 1;; ++calm.attempts) {
    const auto start = Clock::now();
    const Watch watch;
    measure(calm.attempts);
    const Conditions during = watch.stop();
    note_calibration(during.calibration_ms);
    calm.dirty = disturbed(during, best_calibration_ms_, threads) ? 1 : 0;
    calm.calibration_ms = during.calibration_ms;
    calm.others_cores = during.others_cores;
    calm.steal = during.steal;
    if (calm.dirty == 0 || calm.attempts == kAttempts || !again(us_since(start) * 1e-6)) return calm;
  }
}

}  // namespace manzana::apps

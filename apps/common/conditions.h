#pragma once
/// Whether the machine was left to us while something was measured.
///   const Watch watch;                    // before
///   ... measure ...
///   const Conditions during = watch.stop();
///   if (disturbed(during, best_calibration_ms, threads)) again
/// or, all of that:
///   Undisturbed undisturbed;                                           // of the process
///   row.calm = undisturbed.measure(threads, [&](std::uint64_t attempt) { ... }, [](double) { return true; });
#include <cstdint>
#include <functional>

namespace manzana::apps {

struct Conditions {
  double calibration_ms = 0;  ///< a loop of fixed work, the slower of before and after
  double others_cores = 0;    ///< cores that other programs had, on average
  double free_cores = 1;      ///< cores that neither they nor the host took away
  double steal = 0;           ///< share of processor time that went to other guests of the host
};

class Watch {
 public:
  Watch();
  Conditions stop() const;

 private:
  struct Reading {
    double wall_s = 0, busy_s = 0, own_s = 0, steal_s = 0;
  };
  static Reading read();
  double calibration_ms_;
  Reading start_;
};

/// More than 10 % slower than the best calibration seen, or less than our threads and a quarter of a core left (on a
/// machine with no more cores than that: less than 95 % of them), or more than 2 % of the time stolen.
bool disturbed(const Conditions& conditions, double best_calibration_ms, int threads);

/// How it went: columns of many tables (apps/common/run_facts.h).
struct Calm {
  std::uint64_t dirty = 0;  ///< 1: disturbed in every attempt
  std::uint64_t attempts = 1;
  double calibration_ms = 0, others_cores = 0, steal = 0;
};

inline constexpr std::uint64_t kAttempts = 4;  ///< the first, and up to three more when the machine was disturbed

/// Knows how fast the machine can be, from all that it has measured, and measures again while it is disturbed.
class Undisturbed {
 public:
  Undisturbed();                     ///< calibrates
  void note_calibration(double ms);  ///< of measurements made before, by others
  /// `measure` is told the attempt, from 1 on; `again` the seconds that one takes, and says whether there is time.
  Calm measure(int threads, const std::function<void(std::uint64_t)>& measure,
               const std::function<bool(double)>& again);

 private:
  double best_calibration_ms_ = 1e9;
};

/// A few milliseconds of work that depends on the processor's clock alone.
double calibrate_ms();

}  // namespace manzana::apps

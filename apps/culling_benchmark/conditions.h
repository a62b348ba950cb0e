#pragma once
/// Whether the machine was left to us while something was measured.
///   const Watch watch;                    // before
///   ... measure ...
///   const Conditions during = watch.stop();
///   if (disturbed(during, best_calibration_ms, threads)) again
namespace manzana::culling_benchmark {

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

/// A few milliseconds of work that depends on the processor's clock alone.
double calibrate_ms();

}  // namespace manzana::culling_benchmark

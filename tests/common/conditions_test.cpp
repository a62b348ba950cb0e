// Whether the machine was left to us, and what is done when it was not.
#include <catch2/catch.hpp>

#include "apps/common/conditions.h"

using namespace manzana::apps;

TEST_CASE("conditions: a slow calibration, a stolen or a taken machine is disturbed") {
  CHECK_FALSE(disturbed({5, 0, 2, 0}, 5, 1));
  CHECK_FALSE(disturbed({5.4, 0, 2, 0}, 5, 1));
  CHECK(disturbed({5.6, 0, 2, 0}, 5, 1));
  CHECK(disturbed({5, 0, 2, 0.03}, 5, 1));
  CHECK(disturbed({5, 2, 0.5, 0}, 5, 1));
  const Watch watch;
  const Conditions now = watch.stop();
  CHECK(now.calibration_ms > 0.1);
  CHECK(now.others_cores >= 0);
}

TEST_CASE("conditions: what is disturbed is measured again up to four times and while there is time") {
  Undisturbed undisturbed;
  undisturbed.note_calibration(1e-6);  // no machine is that fast: all is disturbed
  std::vector<std::uint64_t> attempts;
  const auto measure = [&](std::uint64_t attempt) { attempts.push_back(attempt); };
  const Calm calm = undisturbed.measure(1, measure, [](double) { return true; });
  CHECK(attempts == std::vector<std::uint64_t>{1, 2, 3, 4});
  CHECK(calm.dirty == 1);
  CHECK(calm.attempts == kAttempts);
  CHECK(calm.calibration_ms > 0.1);
  attempts.clear();
  CHECK(undisturbed.measure(1, measure, [](double seconds) { return seconds < 0; }).attempts == 1);
  CHECK(attempts.size() == 1);
}

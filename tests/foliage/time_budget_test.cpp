// A budget in milliseconds against machines that are made up: what a frame costs by itself and by vertices, how late
// and how noisily that is measured, and how it changes.
#include "foliage/time_budget.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <deque>
#include <limits>
#include <span>
#include <vector>

#include "tests/support/random.h"

namespace manzana::foliage {
namespace {

struct Machine {
  double fixed_ms = 4, ms_a_vertex = 2e-5;
  double noise = 0;              // share of the time, to either side
  double hiccups = 0;            // share of frames that take three times as long
  std::size_t lag = 0;           // frames until a time is known
  double wanted_vertices = 1e9;  // that the view has at the error asked for
};

struct Frame {
  double true_ms = 0, budget = 0;
};

class Simulation {
 public:
  explicit Simulation(std::uint64_t seed) : random_(seed) {}

  Frame draw(const Machine& machine, double wanted_ms) {
    const double drawn = std::min(budget.vertices, machine.wanted_vertices);
    const double ms = machine.fixed_ms + machine.ms_a_vertex * drawn;
    const double noisy = ms * random_.within(1 - machine.noise, 1 + machine.noise);
    times_.push_back(random_.within(0, 1) < machine.hiccups ? 3 * noisy : noisy);
    double known = 0;  // nothing yet
    if (times_.size() > machine.lag) {
      known = times_.front();
      times_.pop_front();
    }
    follow(budget, known, wanted_ms, drawn);
    return {ms, budget.vertices};
  }
  std::vector<Frame> draw(const Machine& machine, double wanted_ms, int frames) {
    std::vector<Frame> all;
    for (int i = 0; i < frames; ++i) all.push_back(draw(machine, wanted_ms));
    return all;
  }
  TimeBudget budget;

 private:
  support::Random random_;
  std::deque<double> times_;
};

/// How often the budget turns from rising to falling, or back.
int turns(std::span<const Frame> frames) {
  int turns = 0, direction = 0;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const int now = (frames[i].budget > frames[i - 1].budget) - (frames[i].budget < frames[i - 1].budget);
    turns += now != 0 && direction != 0 && now != direction;
    if (now != 0) direction = now;
  }
  return turns;
}

constexpr double kWanted = 16;

}  // namespace

TEST_CASE("time budget: a steady machine is held under the wanted time without a turn") {
  const double fixed = GENERATE(0.0, 4.0, 12.0), a_vertex = GENERATE(1e-7, 2e-5, 3e-4);
  const auto lag = GENERATE(std::size_t{0}, std::size_t{3});
  INFO("fixed " << fixed << " a vertex " << a_vertex << " lag " << lag);
  Simulation simulation(1);
  const auto frames = simulation.draw({.fixed_ms = fixed, .ms_a_vertex = a_vertex, .lag = lag}, kWanted, 2400);
  CHECK(turns(frames) == 0);
  for (std::size_t i = 1600; i < frames.size(); ++i) CHECK(frames[i].budget == frames[1600].budget);
  if (fixed + a_vertex * TimeBudget::kFewest > kWanted) {
    CHECK(frames.back().budget == TimeBudget::kFewest);
  } else {
    CHECK(frames.back().true_ms <= 1.001 * kWanted);
    CHECK(frames.back().true_ms >= 0.84 * kWanted);
  }
}

TEST_CASE("time budget: noise and hiccups and lag do not make it swing") {
  const double noise = GENERATE(0.05, 0.1, 0.2);
  const auto seed = GENERATE(range(std::uint64_t{1}, std::uint64_t{6}));
  Simulation simulation(seed);
  const Machine machine{.noise = noise, .hiccups = 0.05, .lag = 3};
  simulation.draw(machine, kWanted, 300);
  const auto frames = simulation.draw(machine, kWanted, 900);
  INFO("noise " << noise << " seed " << seed << " turns " << turns(frames));
  double sum = 0, most = 0, least = 1e9;
  for (const Frame& frame : frames) {
    sum += frame.true_ms;
    most = std::max(most, frame.true_ms);
    least = std::min(least, frame.true_ms);
  }
  CHECK(sum / static_cast<double>(frames.size()) == Approx(0.92 * kWanted).epsilon(0.1));
  CHECK(most < kWanted * (1 + noise));
  CHECK(least > kWanted * (0.85 - noise));
  CHECK(turns(frames) <= (noise < 0.15 ? 10 : 30));  // of a hundred chances
}

TEST_CASE("time budget: a view that is four times as dear is followed within two seconds and left as fast") {
  Simulation simulation(3);
  const Machine cheap{.noise = 0.05, .lag = 3}, dear{.ms_a_vertex = 8e-5, .noise = 0.05, .lag = 3};
  simulation.draw(cheap, kWanted, 400);
  CHECK(simulation.draw(dear, kWanted, 60).back().true_ms < 1.05 * kWanted);
  const auto held = simulation.draw(dear, kWanted, 200);
  CHECK(turns(held) <= 2);
  CHECK(simulation.draw(cheap, kWanted, 120).back().true_ms > 0.8 * kWanted);
}

TEST_CASE("time budget: where trees are not the reason the fewest are drawn and no fewer") {
  Simulation simulation(4);
  const auto frames = simulation.draw({.fixed_ms = 30}, kWanted, 400);
  CHECK(frames.back().budget == TimeBudget::kFewest);
  CHECK(simulation.draw({.fixed_ms = 3}, kWanted, 400).back().true_ms > 0.8 * kWanted);
}

TEST_CASE("time budget: it does not grow where the view needs less and binds at once where it needs more") {
  Simulation simulation(5);
  const auto idle = simulation.draw({.wanted_vertices = 1e5}, kWanted, 2000);
  CHECK(idle.back().budget <= 2.5e5);
  const auto busy = simulation.draw({.ms_a_vertex = 2e-4}, kWanted, 60);
  CHECK(busy.back().true_ms <= 1.05 * kWanted);
}

TEST_CASE("time budget: times that are none change nothing") {
  TimeBudget budget;
  for (int i = 0; i < 100; ++i)
    for (const double ms : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
      follow(budget, ms, kWanted, 1e5);
  CHECK(budget.vertices == TimeBudget{}.vertices);
  CHECK(budget.frames == 0);
}

}  // namespace manzana::foliage

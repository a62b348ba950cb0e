#pragma once
/// Two structures timed side by side. A round is one flight, each query timed alone; a pair is a round of each, in an
/// order that chance decides.
///   const Plan plan = plan_pairs(limits, bqr_us, peer_us, 0);
///   const PairTimes times = time_pairs({&bqr, {}, &frusta}, {&peer, {}, &frusta}, cold, plan, seed);
#include <cstdint>
#include <vector>

#include "apps/culling_benchmark/workload.h"
#include "culling/baselines/peer.h"

namespace manzana::culling_benchmark {

/// How much is to be measured, and what it may cost. The least is measured whatever it costs, and more in those least
/// seconds however little time is left: enough for all of what is quick.
struct Limits {
  double seconds = 1, least_seconds = 0;
  std::size_t pairs = 50, least_pairs = 9, least_frames = 12;
};

struct Plan {
  std::vector<std::size_t> frames;  ///< of the flight, ascending
  std::size_t pairs = 0;
  bool warm_up = false;  ///< each round is flown once more before, untimed
};
/// All frames and all pairs if there is time, else fewer frames, and then fewer pairs. What both structures roughly
/// take is given for each frame, and what goes on between two queries. Few frames must stand for all: they are evenly
/// spread over the ranks of their costs, so that their median is near that of all, wherever in the flight they are.
/// They are then flown once untimed, or caches would be colder than on the whole flight; not if something goes on
/// between.
Plan plan_pairs(const Limits& limits, const std::vector<double>& bqr_us, const std::vector<double>& peer_us,
                double between_us);

/// A structure, and for cases on several threads one more of it for each other thread, which flies at the same time.
struct Contender {
  baselines::Peer* peer = nullptr;
  std::vector<baselines::Peer*> company;
  const std::vector<culling::FrustumD>* flight = nullptr;  ///< both of a pair have as many frames
};

struct PairTimes {
  std::vector<double> peer_us, bqr_us;  ///< a row a pair: the median over the round's frames
  std::vector<double> frame_us;         ///< of the peer: a row a timed frame, the median over the rounds
};
/// cold: memory is streamed between two queries.
PairTimes time_pairs(const Contender& bqr, const Contender& peer, bool cold, const Plan& plan, std::uint64_t seed);

/// What a reading of the clock adds to what is timed, microseconds.
double clock_overhead_us();

/// Of one stream of memory between two queries of a cold case, microseconds.
double stream_us();

}  // namespace manzana::culling_benchmark

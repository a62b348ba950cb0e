#pragma once
/// What every answer is held against: which objects are exactly in view, and what an answer comes to beside that.
///   const Truth truth = find_truth(work);
///   const std::vector<Counts> counts = check(*peer, work, truth);      // a row a frame
#include <cstdint>
#include <filesystem>
#include <vector>

#include "apps/culling_benchmark/workload.h"
#include "culling/baselines/peer.h"

namespace manzana::culling_benchmark {

struct Truth {
  std::vector<std::vector<std::uint64_t>> bits;  ///< a row a frame; bit i % 64 of word i / 64 is object i's
  std::vector<std::uint64_t> seen;               ///< how many are set
};
Truth find_truth(const Workload& work);

/// The same; each process of a run finds what the first one left in `folder`. A file is named by its city's boxes, its
/// views and this program's commit. Throws std::runtime_error when it cannot be written.
Truth kept_truth(const Workload& work, const std::filesystem::path& folder);

/// Of one frame, or of many. An object that an answer holds twice is accepted twice.
struct Counts {
  std::uint64_t accepted = 0, exact = 0, missed = 0, triangles = 0;
  double query_us = 0;  ///< the query that was checked, timed once: for planning only
};

std::vector<Counts> check(baselines::Peer& peer, const Workload& work, const Truth& truth);
Counts sum(const std::vector<Counts>& frames);
std::vector<double> query_times(const std::vector<Counts>& frames);

}  // namespace manzana::culling_benchmark

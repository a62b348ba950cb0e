#pragma once
/// How much of the paper's headline is the grain of the R-tree's pages: triangles that whole blocks and whole pages of
/// blocks send, by the number of blocks in a page. Counts, the same on every machine.
///   const GrainTable table = count_grains(300, seed);
#include <array>
#include <cstdint>

namespace manzana::paper {

inline constexpr std::array<std::uint32_t, 8> kPageBlocks{1, 2, 4, 6, 8, 12, 16, 24};

/// Of one city, sums over the frames of the flight.
struct GrainCounts {
  std::uint64_t none = 0, bqr = 0;                      ///< bqr: whole blocks
  std::array<std::uint64_t, kPageBlocks.size()> vam{};  ///< by kPageBlocks
};
using GrainTable = std::array<GrainCounts, 6>;  ///< C1 ... C6
GrainTable count_grains(int frames, std::uint64_t seed);

}  // namespace manzana::paper

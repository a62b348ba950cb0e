#pragma once
/// A closed forest of seven species with as many triangles as the sources' trees, and the way over it and into it.
#include "apps/foliage_benchmark/ground.h"

namespace manzana::foliage_benchmark {

/// [Gumbau 2009, table 1; Zhang 2004, table 1] and which of our species stands for it.
struct SourceTree {
  const char* species;
  double triangles;
};
std::span<const SourceTree> source_trees();

/// Prepared, side by side. `visibility_side`: of PrepareOptions.
std::vector<foliage::PreparedPlant> prepare_source_trees(std::uint32_t visibility_side);

/// Trees in blocks, as a city has them.
struct Forest {
  std::vector<foliage::PreparedPlant> plants;
  double half_m;
  Ground ground;

  Forest(std::vector<foliage::PreparedPlant> species, std::uint32_t trees, double most_full_quads);
  Forest(const Forest&) = delete;
  Forest& operator=(const Forest&) = delete;

  std::vector<Shot> path(int frames, int height_px) const;
};

}  // namespace manzana::foliage_benchmark

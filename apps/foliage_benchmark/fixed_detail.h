#pragma once
/// Details that are the same at every distance, as the sources' tables ask for them.
///   stage.set_details(same_everywhere(plants, [](const PreparedPlant& p) { return pruned(p, 0.33); }));
#include <span>

#include "foliage/select.h"

namespace manzana::foliage_benchmark {

using foliage::Detail;
using foliage::PreparedPlant;

Detail all_detail(const PreparedPlant& plant);
/// [Gumbau 2009] That share of the leaves, scaled to keep the crown's cover.
Detail pruned(const PreparedPlant& plant, double share);

/// [Gadbem 2011] Parts of a detail taken away, or replaced.
Detail without_leaves(Detail detail);
Detail without_branches(const PreparedPlant& plant, Detail detail);
/// The branches' mesh at a level; beyond the last: none. Lines stand for what it left out, or nothing does.
Detail at_branch_level(const PreparedPlant& plant, std::uint32_t level, bool with_lines);
/// A point for each triangle's area times `area`, of the finest level, in place of leaf quads.
Detail leaves_as_points(const PreparedPlant& plant, double area);

/// The same without fading: of two levels one or the other, leaf quads or points, each leaf whole or not at all.
Detail unfaded(Detail detail);

template <class F>
std::vector<Detail> same_everywhere(std::span<const PreparedPlant> plants, F&& of_plant) {
  std::vector<Detail> details;
  for (const PreparedPlant& plant : plants) details.insert(details.end(), foliage::glsl::kDetailSteps, of_plant(plant));
  return details;
}

}  // namespace manzana::foliage_benchmark

#pragma once
/// A closed forest that fills a picture from above, and one of ten times as many trees from as much farther away: what
/// is seen, and so what a frame takes, should stay about the same.
///   add_from_above(forest.plants, forest_path_plan(quick), times);    // rows of times.csv
#include "apps/foliage_benchmark/forest_path.h"

namespace manzana::foliage_benchmark {

void add_from_above(const std::vector<foliage::PreparedPlant>& plants, const ForestPathPlan& plan, Times& times);

}  // namespace manzana::foliage_benchmark

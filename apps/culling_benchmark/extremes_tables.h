#pragma once
/// Sums over the rows of a run of extremes, by way and by anything else.
#include <functional>
#include <string>
#include <vector>

#include "apps/culling_benchmark/extremes.h"

namespace manzana::culling_benchmark {

struct ExtremesSum {
  double asked = 0, seen = 0, missed = 0, falsely_kept = 0, deepest_missed_m = 0;
  void add(const ExtremesRow& row);
  double missed_percent() const { return seen > 0 ? 100 * missed / seen : 0; }
  double falsely_kept_percent() const { return asked > seen ? 100 * falsely_kept / (asked - seen) : 0; }
};

using ExtremesFilter = std::function<bool(const ExtremesRow&)>;
using ExtremesKey = std::function<std::string(const ExtremesRow&)>;

ExtremesSum sum(const Extremes& extremes, const ExtremesFilter& which);

/// A row a way, a column a key, in the order of their first rows; the first row is the head.
std::vector<std::vector<std::string>> pivot(const Extremes& extremes, const ExtremesFilter& which,
                                            const ExtremesKey& key,
                                            const std::function<std::string(const ExtremesSum&)>& cell);

/// "0.01 / 1 000 000", "0.01 / infinite"
std::string depths_text(double near_m, double far_m);
inline std::string by_depths(const ExtremesRow& row) { return depths_text(row.near_m, row.far_m); }
std::string by_field(const ExtremesRow& row);

/// A heat map: what share of the seen objects each way misses, by place, depths, field of view and sort of object.
std::string extremes_svg(const Extremes& extremes);

}  // namespace manzana::culling_benchmark

#include "apps/walkthrough/frame_log.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace manzana::walkthrough {

std::string to_csv(std::span<const FrameRow> rows) {
  std::string csv =
      "frame,cull_us,update_us,draw_ms,blocks_visible,buildings_visible,trees_visible,cars_visible,triangles\n";
  char line[256];
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const FrameRow& r = rows[i];
    const auto n = [](std::uint64_t count) { return static_cast<unsigned long long>(count); };
    std::snprintf(line, sizeof line, "%zu,%.2f,%.2f,%.3f,%llu,%llu,%llu,%llu,%llu\n", i, r.cull_us, r.update_us,
                  r.draw_ms, n(r.blocks_visible), n(r.buildings_visible), n(r.trees_visible), n(r.cars_visible),
                  n(r.triangles));
    csv += line;
  }
  return csv;
}

double quantile(std::vector<double> values, double p) {
  if (values.empty()) return 0;
  const auto rank = static_cast<std::size_t>(std::ceil(p * static_cast<double>(values.size())));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::clamp<std::size_t>(rank, 1, values.size()) - 1);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace manzana::walkthrough

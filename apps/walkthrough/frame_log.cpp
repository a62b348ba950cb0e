#include "apps/walkthrough/frame_log.h"

#include <cstdio>

namespace manzana::walkthrough {

std::string to_csv(std::span<const FrameRow> rows) {
  std::string csv =
      "frame,cull_us,update_us,draw_ms,blocks_visible,buildings_visible,trees_visible,cars_visible,triangles,points,"
      "tree_error_px\n";
  char line[256];
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const FrameRow& r = rows[i];
    const auto n = [](std::uint64_t count) { return static_cast<unsigned long long>(count); };
    std::snprintf(line, sizeof line, "%zu,%.2f,%.2f,%.3f,%llu,%llu,%llu,%llu,%llu,%llu,%.3f\n", i, r.cull_us,
                  r.update_us, r.draw_ms, n(r.blocks_visible), n(r.buildings_visible), n(r.trees_visible),
                  n(r.cars_visible), n(r.triangles), n(r.points), r.tree_error_px);
    csv += line;
  }
  return csv;
}

}  // namespace manzana::walkthrough

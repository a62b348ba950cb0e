#pragma once
/// What was measured and counted in each frame, and what it comes to over a path.
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "foliage/detail.h"

namespace manzana::walkthrough {

/// Times by a steady clock. cull_us: find_visible alone; update_us: find_cars alone; draw_ms: from there to the end of
/// glFinish (where the device is waited for), without read-back. triangles, points: submitted.
struct FrameRow {
  double cull_us = 0, update_us = 0, draw_ms = 0;
  std::uint64_t blocks_visible = 0, buildings_visible = 0, trees_visible = 0, cars_visible = 0, triangles = 0,
                points = 0;
  double tree_error_px = 0;  ///< tolerated in trees; more than asked for where a budget or the memory binds
  foliage::Law tree_law = foliage::Law::ours;  ///< ours in place of what there was no room for
  std::uint64_t meshes_missing = 0;            ///< bytes of meshes in sight that were left out for want of room
  std::uint64_t trees_missing = 0;             ///< list entries of trees that were left out for want of room
  double frame_ms() const { return cull_us / 1000 + update_us / 1000 + draw_ms; }
};

/// frames.csv: a head, then a row a frame.
std::string to_csv(std::span<const FrameRow> rows);

/// One column of the rows: `get` is a member, or a function of a row.
template <class Get>
std::vector<double> column(std::span<const FrameRow> rows, Get get) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const FrameRow& row : rows) values.push_back(static_cast<double>(std::invoke(get, row)));
  return values;
}

}  // namespace manzana::walkthrough

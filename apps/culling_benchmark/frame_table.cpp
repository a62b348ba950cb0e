#include "apps/culling_benchmark/frame_table.h"

#include <array>

namespace manzana::culling_benchmark {
namespace {

using C = apps::Column<FrameRow>;

const std::array kColumns{
    C{"frame", "", "of the flight, from 0", &FrameRow::frame},
    C{"us", "us", "of the query: median over the rounds; empty: not a timed frame", &FrameRow::us},
    C{"accepted", "objects", "in the answer", &FrameRow::accepted},
    C{"exact", "objects", "whose box meets the view", &FrameRow::exact},
    C{"triangles", "", "of accepted objects", &FrameRow::triangles},
};

}  // namespace

std::span<const apps::Column<FrameRow>> frame_columns() { return kColumns; }

std::vector<FrameRow> frame_table(const std::vector<Counts>& counts, const Plan& plan, const PairTimes& times) {
  std::vector<FrameRow> rows;
  for (std::size_t i = 0; i < counts.size(); ++i)
    rows.push_back({i, std::nullopt, counts[i].accepted, counts[i].exact, counts[i].triangles});
  for (std::size_t i = 0; i < plan.frames.size(); ++i) rows[plan.frames[i]].us = times.frame_us[i];
  return rows;
}

std::string to_csv(std::span<const FrameRow> rows) {
  std::string csv = apps::head_line(frame_columns());
  for (const FrameRow& row : rows) csv += apps::to_line(row, frame_columns());
  return csv;
}

}  // namespace manzana::culling_benchmark

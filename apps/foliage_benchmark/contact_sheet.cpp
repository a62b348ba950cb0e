#include "apps/foliage_benchmark/contact_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/common/markdown.h"

namespace manzana::foliage_benchmark {
namespace {

using foliage::Law;

struct Row {
  Law law;
  Sampling sampling;
  const char* name;
};
constexpr std::array<Row, 3> kRows{{{Law::full, Sampling::fine, "full detail, many samples"},
                                    {Law::full, Sampling::product, "full detail, 4 samples"},
                                    {Law::ours, Sampling::product, "level of detail, 4 samples"}}};

struct Cell {
  Picture picture;
  std::string words;
};

/// One distance: its rows, cut alike and enlarged alike.
std::array<Cell, kRows.size()> column_of(Stage& stage, std::uint32_t plant, double height_px, int times,
                                         double error_px) {
  const Shot shot = shot_of(extent_of(stage.plants()[plant]), 0.4, 0.05, height_px);
  std::array<Cell, kRows.size()> cells;
  Box box;
  for (std::size_t i = 0; i < kRows.size(); ++i) {
    stage.set_law(kRows[i].law);
    cells[i].picture = stage.draw({plant, plant + 1}, shot, {error_px, kRows[i].sampling});
    cells[i].words = apps::grouped(static_cast<double>(primitives_of(stage.shown()))) + " primitives";
    box = united(box, covered_box(cells[i].picture));
  }
  for (Cell& cell : cells) cell.picture = enlarged(cropped(cell.picture, box), times);
  return cells;
}

}  // namespace

Picture contact_sheet(Stage& stage, std::uint32_t plant, std::span<const double> heights_px, double error_px) {
  constexpr int kGap = 12;
  std::vector<std::array<Cell, kRows.size()>> columns;
  int width = 0, height = 0;
  for (const double px : heights_px) {
    columns.push_back(column_of(stage, plant, px, static_cast<int>(std::lround(heights_px.front() / px)), error_px));
    width = std::max({width, columns.back().front().picture.width, words(columns.back().front().words).width});
    height = std::max(height, columns.back().front().picture.height);
  }
  std::vector<Picture> rows;
  for (std::size_t row = 0; row < kRows.size(); ++row) {
    std::vector<Picture> cells;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const std::string distance = std::to_string(std::lround(heights_px[i])) + " px high";
      const Cell& cell = columns[i][row];
      const Picture name = words(row == 0 ? distance : cell.words);
      cells.push_back(below(std::array{framed(cell.picture, width, height), framed(name, width, name.height)}));
    }
    const std::string name = row == 0 ? stage.plants()[plant].name + ": " + kRows[row].name : kRows[row].name;
    rows.push_back(below(std::array{words(name), beside(cells, kGap)}));
  }
  return padded(below(rows, kGap), kGap);
}

}  // namespace manzana::foliage_benchmark

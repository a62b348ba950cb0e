#pragma once
/// Image errors as files: runs.csv, summary.csv, and their section of report.md.
#include "apps/common/csv.h"
#include "apps/common/gnuplot.h"
#include "apps/foliage_benchmark/errors.h"

namespace manzana::foliage_benchmark {

/// What is drawn, and how: as set_way() has it.
template <class Row>
std::vector<apps::Column<Row>> way_columns() {
  using C = apps::Column<Row>;
  return {C{"plant", "", "", &Row::plant},
          C{"height_px", "pixels", "of the plant", &Row::height_px},
          C{"law", "", "of detail: full, ours, gumbau", &Row::law},
          C{"error_px", "pixels", "that may be wrong", &Row::error_px},
          C{"mosaics", "errors", "trees lower than that are mosaics; 0: none are", &Row::mosaics},
          C{"groves", "errors", "blocks of trees lower than that are groves; 0: none are", &Row::groves},
          C{"grove_points", "", "of a grove, for each square of the error", &Row::grove_points}};
}

template <class Row>
std::vector<apps::Column<Row>> picture_columns() {
  using C = apps::Column<Row>;
  return apps::joined<Row>(
      {way_columns<Row>(),
       {C{"sampling", "",
          "fine: as the reference; product: 4 samples a pixel; single: 1; moved: fine, half a pixel beside",
          &Row::sampling},
        C{"bark", "quads", "drawn", &Row::bark}, C{"leaves", "quads", "drawn", &Row::leaves},
        C{"lines", "", "drawn, two triangles each", &Row::lines}, C{"points", "", "drawn", &Row::points},
        C{"primitives", "", "triangles and points drawn", &Row::primitives},
        C{"cover", "", "over the reference's", &Row::cover},
        C{"iou", "", "of the pixels covered by half: intersection over union", &Row::iou},
        C{"silhouette", "", "differences of coverage over the reference's coverage", &Row::silhouette},
        C{"colour", "", "difference of mean colours, linear, root mean square", &Row::colour},
        C{"ssim", "", "mean over the plant's pixels and 5 round them", &Row::ssim},
        C{"gmsd", "", "over the same", &Row::gmsd}, C{"psnr", "dB", "over the same", &Row::psnr}}});
}

/// Of a Verdict, or of what derives from it.
template <class Row>
std::vector<apps::Column<Row>> verdict_columns_of() {
  return apps::joined<Row>({picture_columns<Row>(),
                            {{"floor_ssim", "", "the least that either floor has", &Row::floor_ssim},
                             {"floor_gmsd", "", "the most that either floor has", &Row::floor_gmsd},
                             {"over", "", "what is over the floor; cover within 0.02, colour 0.005", &Row::over}}});
}

std::span<const apps::Column<ErrorRow>> error_columns();
std::span<const apps::Column<Verdict>> verdict_columns();

std::string errors_md(std::span<const Verdict> verdicts, const ErrorPlan& plan);

/// Of each plant: primitives, and each error with its floor, over the height.
std::vector<apps::Script> error_plots(std::span<const Verdict> verdicts);

}  // namespace manzana::foliage_benchmark

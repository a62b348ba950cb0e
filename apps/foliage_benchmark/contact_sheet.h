#pragma once
/// One plant at several distances, full against its levels of detail.
///   write_sheet(file, contact_sheet(stage, plant, {240, 120, 60, 30, 15}, 1));
#include "apps/foliage_benchmark/sheet.h"
#include "apps/foliage_benchmark/stage.h"

namespace manzana::foliage_benchmark {

/// A column a height (each a whole fraction of the first), its pixels enlarged until all are equally large; a row for
/// all detail finely sampled, for all detail as the product samples, and for our law as the product samples.
Picture contact_sheet(Stage& stage, std::uint32_t plant, std::span<const double> heights_px, double error_px);

}  // namespace manzana::foliage_benchmark

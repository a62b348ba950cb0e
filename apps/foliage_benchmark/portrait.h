#pragma once
/// One plant alone on the stage, in one way of drawing it after the other.
#include "apps/foliage_benchmark/errors.h"
#include "apps/foliage_benchmark/fixed_detail.h"
#include "apps/foliage_benchmark/times.h"

namespace manzana::foliage_benchmark {

class Portrait {
 public:
  /// Its first plant, from one side and a little above.
  Portrait(std::span<const foliage::PreparedPlant> plant, double height_px);

  /// Counts, and errors against the reference, both finely sampled.
  void look(const Detail& way, const Detail& reference, TimeRow& row);
  /// Extraction and drawing, as the product samples.
  void time(const Detail& way, const Detail& reference, double seconds, TimeRow& row);

  void use(const Detail& detail);
  Stage& stage() { return stage_; }
  const Shot& shot() const { return shot_; }
  foliage::Run run() const { return {0, 1}; }

 private:
  Stage stage_;
  Shot shot_;
};

std::uint64_t primitives_of(const foliage::Shown& shown);

}  // namespace manzana::foliage_benchmark

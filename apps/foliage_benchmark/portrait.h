#pragma once
/// One plant alone on the stage, in one way of drawing it after the other.
#include "apps/foliage_benchmark/errors.h"
#include "apps/foliage_benchmark/fixed_detail.h"
#include "apps/foliage_benchmark/times.h"

namespace manzana::foliage_benchmark {

class Portrait {
 public:
  /// From one side and a little above. The plant must outlive it.
  Portrait(const foliage::PreparedPlant& plant, double height_px);

  /// Counts, and errors against the reference, both finely sampled.
  void look(const Detail& way, const Detail& reference, TimeRow& row);
  /// Extraction and drawing, as the product samples.
  void time(const Detail& way, const Detail& reference, double seconds, TimeRow& row);
  Picture draw(const Detail& way, Sampling sampling);

  void use(const Detail& detail);
  Stage& stage() { return stage_; }
  const Shot& shot() const { return shot_; }
  foliage::Run run() const { return {0, 1}; }

 private:
  Stage stage_;
  Shot shot_;
  /// The last reference: one serves many ways.
  struct Expected {
    Detail detail;
    Picture picture;
    std::uint64_t primitives = 0;
  };
  std::optional<Expected> expected_;
};

}  // namespace manzana::foliage_benchmark

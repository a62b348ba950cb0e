#pragma once
/// Plants as packs of mosaics on a stage.
///   Packs packs(made);
///   stage.draw(packs.painter(stage, runs, shot, Packs::Way::dithered), shot, Sampling::product);
#include "apps/foliage_benchmark/stage.h"
#include "foliage/gl/draw_ldm.h"

namespace manzana::foliage_benchmark {

class Packs {
 public:
  enum class Way : std::uint8_t { dithered, blended };

  /// One for each of the stage's plants.
  explicit Packs(std::vector<foliage::LdmPack> packs);
  Packs(const Packs&) = delete;
  Packs& operator=(const Packs&) = delete;

  /// Runs and packs must live until it is done.
  Paint painter(const Stage& stage, std::span<const foliage::Run> runs, const Shot& shot, Way way);
  std::uint64_t mosaics() const { return chosen_.mosaics; }  ///< of the last picture
  const foliage::LdmPack& operator[](std::size_t i) const { return packs_[i]; }

 private:
  std::vector<foliage::LdmPack> packs_;
  foliage::LdmDrawer drawer_;
  foliage::LdmSelection chosen_;
};

}  // namespace manzana::foliage_benchmark

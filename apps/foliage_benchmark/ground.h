#pragma once
/// Many plants on level ground, measured from one place or along a path. All detail is drawn of a part of them, and
/// what it takes multiplied.
#include "apps/foliage_benchmark/forest.h"
#include "apps/foliage_benchmark/times.h"
#include "foliage/budget.h"

namespace manzana::foliage_benchmark {

class Ground {
 public:
  /// At most about `most_full_quads` are drawn at once with all detail.
  Ground(std::span<const foliage::PreparedPlant> plants, const std::vector<foliage::TreeSite>& sites,
         double most_full_quads);

  /// From now on plants that are small in the picture are mosaics of packs, as in the walkthrough.
  void make_packs(std::span<const foliage::PreparedPlant> plants);

  /// Ours with all plants in view, with a pixel of error, or with more where so many vertices bind (0: none do),
  /// against all detail of some.
  void measure(const Shot& shot, double vertices, double seconds, TimeRow& row);
  /// Every frame of a path, the least of so many times each: what is left is the frame's own.
  void fly(std::span<const Shot> path, double vertices, int times, TimeRow& row);

 private:
  using Runs = std::vector<foliage::Run>;
  HowDrawn how_drawn(const Runs& runs, const Shot& shot, double vertices);
  void time(const Shot& shot, const HowDrawn& how, const Runs& all, double seconds, TimeRow& row);

  double most_full_quads_;
  std::vector<Extent> extents_;
  Stage stage_;
  foliage::CostTable costs_;
  std::optional<draw::FarTrees> far_;
};

}  // namespace manzana::foliage_benchmark

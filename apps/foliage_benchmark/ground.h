#pragma once
/// Many plants on level ground, measured from one place or along a path. All detail is drawn of a part of them, and
/// what it takes multiplied.
///   Ground ground(plants, sites, 2e6);
///   ground.make_far(plants);
///   ground.fly(path, {.error_px = 0.85}, 3, row);
#include "apps/foliage_benchmark/forest.h"
#include "apps/foliage_benchmark/times.h"
#include "foliage/budget.h"

namespace manzana::foliage_benchmark {

/// So many pixels may be wrong, or more where so many vertices bind (0: none do).
struct Exactness {
  double error_px = 1, vertices = 0;
};

class Ground {
 public:
  /// At most about `most_full_quads` are drawn at once with all detail.
  Ground(std::span<const foliage::PreparedPlant> plants, const std::vector<foliage::TreeSite>& sites,
         double most_full_quads);

  /// From now on plants that are small in the picture are mosaics and groves, as in the walkthrough. They must outlive
  /// this.
  void make_far(std::span<const foliage::PreparedPlant> plants);

  /// Ours with all plants in view against all detail of some.
  void measure(const Shot& shot, const Exactness& exactness, double seconds, TimeRow& row);
  /// The same without all detail: what it shows, and the least time of so many.
  void look(const Shot& shot, const Exactness& exactness, int times, TimeRow& row);
  /// Every frame of a path, the least of so many times each: what is left is the frame's own. What the far side wants
  /// is made before.
  void fly(std::span<const Shot> path, const Exactness& exactness, int times, TimeRow& row);

  Stage& stage() { return stage_; }
  FarSide* far() { return far_ ? &*far_ : nullptr; }
  std::vector<foliage::Run> in_view(const Shot& shot, std::uint32_t every = 1) const;
  /// Ours, with all that the far side wants for it.
  Picture draw(const Shot& shot, const Exactness& exactness, Sampling sampling);
  /// Of that, as the product samples it: samples drawn, hidden or not, over those covered.
  double overdraw(const Shot& shot, const Exactness& exactness);

 private:
  using Runs = std::vector<foliage::Run>;
  /// The budget is of the trees that are near, as in the walkthrough.
  HowDrawn how_drawn(const Runs& runs, const Shot& shot, const Exactness& exactness);
  void draw_frame(const Shot& shot, const Exactness& exactness);
  double least_ms(const Shot& shot, const Exactness& exactness, int times);
  HowDrawn show(const Shot& shot, const Exactness& exactness, TimeRow& row);
  void make_wanted(const Shot& shot, const Exactness& exactness);
  void time(const Shot& shot, const HowDrawn& how, const Runs& all, double seconds, TimeRow& row);

  double most_full_quads_;
  std::vector<Extent> extents_;
  Stage stage_;
  foliage::CostTable costs_;
  std::optional<FarSide> far_;
  std::vector<std::uint32_t> words_;  // of the frame at hand
};

}  // namespace manzana::foliage_benchmark

#pragma once
/// How many pixels a plant covers, from eight sides: what sizes and numbers of its parts are fitted to.
///   const Silhouettes pictures(plant, std::array{0.05, 0.6});
///   covered(pictures.coverage(u, scale)) / covered(pictures.coverage(1, 1))   // 1: as much as all of it
///   covered(pictures.coverage(chosen)) / covered(pictures.coverage(1, 1))     // of eight trees, a side each
#include <span>

#include "foliage/parallel_view.h"
#include "foliage/raster.h"
#include "foliage/select.h"

namespace manzana::foliage {

class Silhouettes {
 public:
  static constexpr std::size_t kViews = 8;
  using Coverage = std::array<std::size_t, kViews>;  ///< pixels

  /// From half around, since a silhouette is the same from behind. `rises`, taken by turns: how much higher the eye is
  /// than the plant, over how far away. The plant must outlive it; its parts may change size but not number.
  Silhouettes(const PreparedPlant& plant, std::span<const double> rises);

  float pixel_m2() const { return 1 / (views_[0].pixels_of(1) * views_[0].pixels_of(1)); }

  /// All branches; of each cell the share u of its leaves, scaled so.
  Coverage coverage(double u, float scale) const;

  /// What is chosen of eight trees of a table of this plant alone, of each from one of the sides. Points are squares;
  /// lines of leaves are not drawn, since their width is not the same from all sides.
  Coverage coverage(const Selection& chosen) const;

 private:
  using Hits = std::vector<std::uint8_t>;  // with room for a block past the last pixel

  template <class Draw>  // void(std::size_t view, Hits&)
  Coverage counted(Draw&& draw_all) const;
  void draw(const Item& item, std::uint32_t rank, const ParallelView& view, Hits& hits) const;
  void draw(const PlantQuad& quad, float scale, bool leaf, const ParallelView& view, Hits& hits) const;

  const PreparedPlant& plant_;
  LeafHoles holes_;
  std::vector<ParallelView> views_;
  std::vector<Hits> bark_;
};

/// Of all views together.
double covered(const Silhouettes::Coverage& coverage);

}  // namespace manzana::foliage

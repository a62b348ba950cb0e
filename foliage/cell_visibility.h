#pragma once
/// How much of a cell of leaves can be seen from each side. [Gumbau 2009, section 4.2] The source asks the GPU four
/// times for each cell and view; foliage/gl/cell_visibility.h does that, and has a faster way. Here pictures of cell
/// ids are drawn on the CPU: the way without a GL, and the oracle for those with one.
///   bake_visibility(plant, {.side = 9});
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "foliage/cell_pieces.h"
#include "foliage/progress.h"

namespace manzana::foliage {

struct VisibilityOptions {
  std::uint32_t side = 9;  ///< of the octahedral grid of directions; at least 2, at most 257
  int pixels = 0;          ///< along each side of a picture; 0: as many as give kEnoughPixels a cell
  Progress progress{};
};

/// Of a cell, alone and among the others: a share of n pixels scatters by at most 1 / (2 sqrt(n)), here 0.016.
inline constexpr std::uint32_t kEnoughPixels = 1000;

/// Of each cell, seen by parallel rays: pixels that it would have alone, and those that it has among all cells and the
/// finest bark, from this end of the rays and from their other one. Leaves have the holes of their picture. Where two
/// cells are equally near, the latter is seen.
struct CellPixels {
  std::vector<std::uint32_t> own, seen, seen_from_behind;
};
/// With `only`, of that cell alone; 0 for the others.
using CountPixels = std::function<CellPixels(const ParallelView&, std::optional<std::uint32_t> only)>;

class LeafHoles;

/// A CountPixels on the CPU, for any number of threads at once. The plant must stay as it is.
class CellCounter {
 public:
  explicit CellCounter(const PreparedPlant& plant);
  CellPixels operator()(const ParallelView& view, std::optional<std::uint32_t> only = {}) const;

 private:
  bool is_leaf(const CellPiece& piece) const { return piece.cell < plant_.cells.size(); }
  std::span<const PlantQuad> quads_of(const CellPiece& piece) const;
  std::vector<const CellPiece*> in_front(const ParallelView& view, float farthest) const;
  void count_all(const ParallelView& view, CellPixels& count) const;
  std::pair<std::uint32_t, std::uint32_t> count_one(const ParallelView& view, std::uint32_t cell) const;

  const PreparedPlant& plant_;
  std::vector<CellPiece> pieces_;
  std::shared_ptr<const LeafHoles> holes_;
};

/// Pixels along the side of a picture in which most cells have kEnoughPixels, from one side; 256 to 2048.
int picture_size(const PreparedPlant& plant, const CountPixels& count);

/// From such a picture, and nearer ones of the cells that have too few in it. Seen from their edge cells may have fewer
/// still: no picture has more than 512 pixels a side for one cell.
CellPixels enough_pixels(const PreparedPlant& plant, const ParallelView& view, const CountPixels& count);

/// seen / own in 255ths, to the nearest but not to 0 unless it is. Without a pixel: 255 for a cell with leaves, 0 for
/// an empty one.
std::uint8_t seen_share(std::uint32_t seen, std::uint32_t own, bool empty);

/// Fills plant.visibility. Both vertices of a pair (foliage/octahedral.h) have the same shares. Deterministic; on all
/// cores. Throws std::invalid_argument for options out of range.
void bake_visibility(PreparedPlant& plant, const VisibilityOptions& options = {});

/// The same by another count, in this thread.
void bake_visibility(PreparedPlant& plant, const VisibilityOptions& options, const CountPixels& count);

}  // namespace manzana::foliage

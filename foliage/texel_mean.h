#pragma once
/// The mean colour and alpha of a picture under a triangle. [Gadbem 2011, section 3.5: a point has the mean colour of
/// the texels that are not transparent] Here weighted by alpha, and in linear light.
#include <array>
#include <vector>

#include "culling/vec.h"
#include "foliage/image.h"

namespace manzana::foliage {

struct TexelMean {
  Vec3d colour{0};        ///< linear, in [0, 1]; 0 where all is transparent
  double alpha = 0;       ///< in [0, 1]
  double square = 0;      ///< of smooth_luminance(), mean by alpha
  Vec3d middle{1.0 / 3};  ///< barycentric: where alpha has its centre of mass
};

/// Of each texel, the luminance of the square of 4 x 4 texels that it is in, mean by alpha: what is smaller is not seen
/// from where leaves are a few pixels wide.
std::vector<float> smooth_luminance(const Image& image);

/// Keeps tables for one picture; the picture may go.
class TexelMeans {
 public:
  explicit TexelMeans(const Image& image);

  /// Exactly over the triangle's area, a texel being a square of one colour; uv repeat. Of a triangle without area, the
  /// texel at its middle. Cost: the texels touched. uv finite, within 1e4.
  TexelMean over(const std::array<Vec2d, 3>& uv) const;

 private:
  struct Sums;
  void add_row(const std::array<Vec2d, 3>& texels, int row, Sums& sums) const;
  std::size_t place(int x, int y) const;

  int size_;
  std::vector<Vec4d> texels_;  // linear colour times alpha, alpha
  std::vector<float> luminance_;
};

}  // namespace manzana::foliage

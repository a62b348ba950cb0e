#include "foliage/ldm_mosaics.h"

#include <algorithm>
#include <cmath>

namespace manzana::foliage {
namespace {

/// Depth in slabs.
double depth_of(const LdmTexel& texel, int layer) { return layer + texel.depth / 255.0; }

class Splitter {
 public:
  Splitter(const LdmPlace& place, const LdmOptions& options, double radius, double distance)
      : place_(place),
        options_(options),
        slab_m_(2 * radius / place.image.layers),
        radius_(radius),
        distance_(distance) {}

  void split(int left, int low, int side) {
    const LdmStretch stretch = stretch_of(place_, left, low, side);
    if (stretch.visible == 0) return;
    const int half = side / 2;
    if (half < options_.smallest || fits(stretch)) return keep(stretch);
    for (const int y : {low, low + half})
      for (const int x : {left, left + half}) split(x, y, half);
  }
  std::vector<LdmMosaic> mosaics;

 private:
  bool fits(const LdmStretch& stretch) const {
    const double to_plane = distance_ - radius_ + stretch.mean * slab_m_;
    const double allowed =
        (1 + static_cast<double>(options_.occlusion) * stretch.hidden) * static_cast<double>(options_.disparity_px);
    return disparity(stretch.farthest * slab_m_, to_plane, options_.focal_px) < allowed;
  }

  void keep(const LdmStretch& s) {
    const double depth = 65535 * s.mean / place_.image.layers;
    const auto byte = [](int v) { return static_cast<std::uint8_t>(v); };
    mosaics.push_back(
        {0, static_cast<std::uint16_t>(std::lround(depth)), byte(s.left), byte(s.low), byte(s.right), byte(s.high)});
  }

  const LdmPlace& place_;
  const LdmOptions& options_;
  double slab_m_, radius_, distance_;
};

}  // namespace

LdmStretch stretch_of(const LdmPlace& place, int left, int low, int side) {
  LdmStretch stretch;
  const int first_x = place.column * kLdmBlock, first_y = place.row * kLdmBlock;
  double depths = 0, hidden = 0, least = 1e9, most = -1e9;
  for (int y = low; y < low + side; ++y) {
    for (int x = left; x < left + side; ++x) {
      const LdmTexel& texel = place.image.at(place.layer, first_x + x, first_y + y);
      if (texel.colour[3] == 0) continue;
      const double alpha = texel.colour[3] / 255.0, depth = depth_of(texel, place.layer);
      stretch.visible += alpha;
      hidden += alpha * static_cast<double>(place.hidden[place.image.index(0, first_x + x, first_y + y)]);
      depths += alpha * depth;
      least = std::min(least, depth), most = std::max(most, depth);
      stretch.left = std::min(stretch.left, x), stretch.right = std::max(stretch.right, x + 1);
      stretch.low = std::min(stretch.low, y), stretch.high = std::max(stretch.high, y + 1);
    }
  }
  if (stretch.visible == 0) return stretch;
  stretch.hidden = hidden / stretch.visible;
  stretch.mean = depths / stretch.visible;
  stretch.farthest = std::max(most - stretch.mean, stretch.mean - least);
  return stretch;
}

std::vector<LdmMosaic> split_block(const LdmPlace& place, const LdmOptions& options, double radius, double distance) {
  Splitter splitter(place, options, radius, distance);
  splitter.split(0, 0, kLdmBlock);
  return std::move(splitter.mosaics);
}

}  // namespace manzana::foliage

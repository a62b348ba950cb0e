#pragma once
/// The ways of culling that are found in the field, none with a margin for what is rounded: every box against six
/// planes, by the corner that is farthest along the normal. What they lose is what the margins of culling/overlap.h are
/// for; they are held up to nobody's structure, so no query is timed here.
///   for (const NaiveWay& way : naive_ways()) std::vector<bool> kept = way.kept(view, boxes);
#include <span>
#include <string_view>
#include <vector>

#include "culling/baselines/host_matrices.h"
#include "culling/volumes.h"

namespace manzana::baselines {

struct NaiveWay {
  std::string_view slug, what, precision;
  /// A flag a box.
  std::vector<bool> (*kept)(const culling::View& view, std::span<const culling::BoxD> boxes);
  /// Distance from the eye to the far plane of this way, metres; NaN when its normal is nothing. The view has one.
  double (*far_m)(const culling::View& view);
};

/// From the worst to the best. Matrices are OpenGL's, with depths -1 to 1.
std::span<const NaiveWay> naive_ways();

}  // namespace manzana::baselines

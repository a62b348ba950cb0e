#pragma once
/// What a visitor would want to see of a city, found by counting: its heart, its largest wood, its river.
///   Survey survey = survey_city(scene);
#include <optional>
#include <vector>

#include "scenegraph/scene.h"

namespace manzana::walkthrough {

struct Survey {
  Vec2d center{0, 0};         ///< median of the buildings (of all there is, without buildings), plan
  double radius = 100;        ///< nine in ten buildings lie within, at least 100 m; of plants alone, at least 5 m
  Vec2d heart{0, 0};          ///< where most is built, not too far from the centre
  std::optional<Vec2d> wood;  ///< where most trees stand together
  std::vector<Vec2d> river;   ///< along the longest water, at least 300 m; empty without one
};

/// O(n log n). A scene without objects has all at the anchor.
Survey survey_city(const Scene& scene);

}  // namespace manzana::walkthrough

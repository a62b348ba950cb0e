#pragma once
/// Outlines of cars, and the proof that a plan of traffic keeps them apart. Private to build_traffic.
#include <utility>
#include <vector>

#include "scenegraph/traffic.h"

namespace manzana {

inline constexpr double kCarLength = 4.5, kCarWidth = 1.9;  ///< metres: what cars are kept apart for
inline constexpr double kHeadroom = 2.5;                    ///< metres of height between cars that cannot touch

/// A car in plan: centre, unit heading, height.
struct CarOutline {
  Vec2d position, forward;
  double height;
};
/// Rectangles enlarged by so much in all, metres; by separating axes.
bool touch(const CarOutline& a, const CarOutline& b, double more_length, double more_width);

/// Pairs of half-streets on which cars touch while a cycle goes by. With a car at every place all later cycles are like
/// the first one, so when none is found for all places, no cars ever touch. Sampled every 0.1 s with a margin.
std::vector<std::pair<std::uint32_t, std::uint32_t>> find_meetings(const Traffic& full, double cycle_s);

}  // namespace manzana

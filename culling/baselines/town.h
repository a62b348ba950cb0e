#pragma once
/// A town drawn by chance, the same on every machine: blocks of 60 to 120 m between streets and avenues, houses round
/// their edges with a few towers, trees along the pavements and in the yards, cars in the half-streets.
///   City c2 = grow_town({.blocks = 96, .columns = 12, .per_block = 31, .triangles = 1'688'023}, seed);
#include "culling/baselines/city.h"

namespace manzana::baselines {

struct TownPlan {
  std::uint32_t blocks = 1, columns = 1;  ///< rows of blocks, from south to north; the last may be shorter
  std::uint32_t per_block = 25;           ///< objects, on average: each block has up to ten more or fewer
  std::uint64_t triangles = 0;            ///< of all objects together, exactly; more than the cars have
};

inline constexpr std::uint32_t kCarTriangles = 387;  ///< [Pina 2009, 4.2]

/// Centred at L's origin, on the plane z = 0. Two plans that differ in triangles alone give the same boxes.
City grow_town(const TownPlan& plan, std::uint64_t seed);

}  // namespace manzana::baselines

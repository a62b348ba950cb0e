#pragma once
/// A made-up terrain of hills some 25 m high, cells of 40 m, under all of a city that is 2 km across.
#include <cmath>

#include "scenegraph/import/terrain.h"

inline manzana::Terrain hills() {
  manzana::Terrain t;
  t.origin = {-2010, -1990};
  t.step = 40;
  t.columns = t.rows = 101;
  for (std::uint32_t r = 0; r < t.rows; ++r)
    for (std::uint32_t c = 0; c < t.columns; ++c)
      t.heights.push_back(
          static_cast<float>(25 + 15 * std::sin(0.31 * c) * std::cos(0.27 * r) + 10 * std::sin(0.11 * r)));
  return t;
}

#pragma once
/// Which triangles hang together.
#include <cstdint>
#include <span>
#include <vector>

#include "culling/vec.h"

namespace manzana::foliage {

/// Vertices that lie at one place, to a hundred-thousandth of the whole's extent, have the same number: the first
/// such vertex's. Seams of tubes and of texture coordinates close.
std::vector<std::uint32_t> joined_by_place(std::span<const Vec3> positions);

/// The triangles of connected pieces, numbered by their first triangle.
struct Pieces {
  std::vector<std::uint32_t> first;      ///< piece p: triangles[first[p]] to triangles[first[p + 1]]
  std::vector<std::uint32_t> triangles;  ///< rising within a piece
  std::size_t count() const { return first.empty() ? 0 : first.size() - 1; }
  std::span<const std::uint32_t> of(std::size_t p) const {
    return std::span(triangles).subspan(first[p], first[p + 1] - first[p]);
  }
};

/// Triangles (three of `corners` each) are connected by a common corner, if their `key` is the same.
Pieces connected_pieces(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> key);

}  // namespace manzana::foliage

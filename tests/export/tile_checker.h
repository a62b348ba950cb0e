#pragma once
/// Reads a tileset as a viewer would, and says what is wrong with it: every vertex of every instance must lie in its
/// tile's volume, and every tile's volume in its parent's. Other checkers do not look at instances.
///   const CheckedTiles checked = check_tiles("helsinki-tiles");
///   CHECK(checked.faults.empty());
#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "culling/vec.h"

namespace manzana {

struct CheckedTiles {
  std::size_t tiles = 0, contents = 0, nodes = 0, instances = 0, vertices = 0, features = 0;
  std::vector<std::string> faults;
};

/// Throws std::runtime_error for a file that cannot be read.
CheckedTiles check_tiles(const std::filesystem::path& folder);

/// A triangle of a tile, in its frame, with the feature of its first corner; or -1.
struct TileTriangle {
  std::array<Vec3d, 3> corners;
  int feature = -1;
};

/// A content as it is drawn: z up, instances placed.
struct DecodedContent {
  std::vector<TileTriangle> buildings, others;
  std::vector<Vec3d> vertices;
  std::size_t instances = 0;
  std::map<std::string, std::vector<std::string>> texts;  ///< "building.id": a row each
  std::map<std::string, std::vector<float>> numbers;      ///< "tree.height"
  std::vector<std::string> faults;
};
DecodedContent decode_content(const std::filesystem::path& glb);

}  // namespace manzana

#pragma once
/// From centre lines in any order to a tree of branches.
#include <vector>

#include "foliage/plant.h"

namespace manzana::foliage {

struct JoinedLines {
  std::vector<std::uint32_t> order;  ///< row -> number of the line; parents precede children
  std::vector<std::int32_t> parent;  ///< of a row: a row, or -1
  std::vector<std::uint16_t> level;  ///< of a row: the parent's and one
};

/// Turns each line so that its foot comes first: the thicker end, or, of ends that are alike, the one that is nearer to
/// another line, or the ground. Its parent is the branch whose surface is nearest to its foot. Lines that stand on the
/// ground apart from others have none.
JoinedLines join_lines(std::vector<std::vector<CentrePoint>>& lines);

}  // namespace manzana::foliage

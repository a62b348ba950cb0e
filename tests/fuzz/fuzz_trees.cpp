// Any bytes, read as a list of trees: trees that are sound, or a std::runtime_error, and nothing else. The first byte
// says whether as GeoJSON or as a table.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>

#include "scenegraph/import/tree_list.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    for (const auto& tree : manzana::read_tree_bytes(bytes, (data[0] & 1) != 0, {}, {}).trees)
      if (!std::isfinite(tree.position.x + tree.position.y) || !(tree.height > 0) || !(tree.crown_radius > 0))
        std::abort();
  } catch (const std::runtime_error&) {
  }
  return 0;
}

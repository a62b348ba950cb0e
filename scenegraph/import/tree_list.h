#pragma once
/// Lists of trees, as towns and foresters keep them: docs/cityjson.md says what is taken from them.
#include "scenegraph/import/import.h"

namespace manzana {

/// For tests of bytes. Throws std::runtime_error without the file's name.
CityFeatures read_tree_bytes(std::string_view bytes, bool geojson, const TreeColumns& columns,
                             const ImportOptions& options);

}  // namespace manzana

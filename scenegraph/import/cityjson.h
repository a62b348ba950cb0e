#pragma once
/// CityJSON 1.0 to 2.0, and CityJSON text sequences (a feature a line). What is read, and by which rules:
/// docs/cityjson.md.
///   CityFeatures city = read_cityjson("delft.city.json", {}, show);
#include "scenegraph/import/import.h"

namespace manzana {

/// By its name (.city.json, .jsonl) or, for other .json, by what it holds. False where it cannot be read.
bool is_cityjson(const std::filesystem::path& file);

/// For tests of bytes. `sequence`: a document or feature a line. `folder`: of its pictures. Throws std::runtime_error
/// without the file's name.
CityFeatures read_cityjson_bytes(std::string_view bytes, bool sequence, const ImportOptions& options,
                                 const Progress& progress, const std::optional<std::filesystem::path>& folder = {});

}  // namespace manzana

#pragma once
/// A city that was imported before: FILE.manzana. Its columns lie in the file as they lie in memory, each with its
/// checksum. The file is mapped: meshes, lanes, pictures and what neighbours hide of trees stay in it, and come to
/// memory piece by piece as they are looked at; the other columns are copied. What is left of an import is the time to
/// read and check. Pictures that buildings wear are in it as they were encoded: it refers to no other file.
///   write_baked("city.manzana", import_city("city.osm.pbf"));     // manzana-bake import
///   Imported city = import_city("city.manzana");                   // as any other
/// For this machine's byte order, and this version alone: a file of another is refused, to be baked again. Whole or not
/// at all: it is written beside, then renamed. What is read is checked so far that nothing that uses a scene leaves its
/// columns, whatever the bytes are.
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "scenegraph/import/import.h"

namespace manzana {

inline constexpr std::uint32_t kBakedVersion = 4;

bool is_baked(const std::filesystem::path& file);  ///< by its name

/// Throws std::runtime_error ("FILE: what") when it cannot be written, for plants of an ecosystem, whose models the
/// file would lack, and for a picture that is not there any more.
void write_baked(const std::filesystem::path& file, const Imported& city);

/// Throws std::runtime_error ("FILE: what", one line).
Imported read_baked(const std::filesystem::path& file);

/// From memory; `name` stands in messages.
Imported read_baked_bytes(std::span<const std::byte> bytes, const std::string& name);
std::string baked_bytes(const Imported& city);

}  // namespace manzana

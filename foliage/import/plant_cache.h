#pragma once
/// Prepared plants on disk: preparing takes seconds, reading them back milliseconds. Kept by
/// foliage/import/load_plant.h.
///   write_prepared("oak.plant", prepare(oak));
///   const PreparedPlant again = read_prepared("oak.plant");
/// The file: "MANZANA\x1a", byte order, format, length and checksum (XXH3, 64 bits) of what follows; then every list
/// with the size of its elements and their count. It is there whole or not at all, nothing is allocated on its word,
/// and what is read has passed check().
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "foliage/prepared_plant.h"

namespace manzana::foliage {

/// Of files, of what a species' seed grows to, and of what prepare() makes of a plant: raised whenever one changes.
inline constexpr std::uint32_t kPlantFormat = 14;

std::string encoded(const PreparedPlant& plant);
std::uint64_t checksum_of(const PreparedPlant& plant);  ///< of all that encoded() has

/// Throws std::runtime_error for anything but what encoded() wrote.
PreparedPlant decoded(std::span<const unsigned char> bytes);

/// What encoded() puts before the lists, for a checksum that holds: for fuzzing what lies behind it.
std::string with_header(std::string_view lists);

/// Both throw std::runtime_error ("FILE: what").
void write_prepared(const std::filesystem::path& file, const PreparedPlant& plant);
PreparedPlant read_prepared(const std::filesystem::path& file);

}  // namespace manzana::foliage

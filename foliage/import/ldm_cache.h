#pragma once
/// Packs of mosaics on disk: making one takes seconds, reading it back milliseconds. The file is as those of prepared
/// plants (foliage/import/plant_cache.h): there whole or not at all, with a format and a checksum, and what is read has
/// passed check().
///   const LdmPack pack = load_or_make_pack(plant, default_cache_folder(), {}, make, tell);
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "foliage/import/cache_file.h"
#include "foliage/import/load_plant.h"
#include "foliage/ldm_pack.h"

namespace manzana::foliage {

/// Of files, and of what make_ldm_pack() and its samplers make of a plant: raised whenever one changes.
inline constexpr std::uint32_t kPackFormat = 7;

inline constexpr CacheKind kPackKind{{'M', 'A', 'N', 'Z', 'L', 'D', 'M', '\x1a'}, kPackFormat, "pack"};

std::string encoded(const LdmPack& pack);
/// Throws std::runtime_error for anything but what encoded() wrote.
LdmPack decoded_pack(std::span<const unsigned char> bytes);

/// Both throw std::runtime_error ("FILE: what").
void write_pack(const std::filesystem::path& file, const LdmPack& pack);
LdmPack read_pack(const std::filesystem::path& file);

/// What the folder keeps of the same plant and options; else what `make` makes, kept there. Without a folder nothing is
/// kept. `tell` gets a line when a kept pack is damaged and made again, or cannot be kept.
LdmPack load_or_make_pack(const PreparedPlant& plant, const std::optional<std::filesystem::path>& cache_folder,
                          const LdmOptions& options, const std::function<LdmPack()>& make, const TellLine& tell);

/// The same of foliage/far_pack.h.
LdmPack load_or_make_far_pack(const PreparedPlant& plant, const std::optional<std::filesystem::path>& cache_folder,
                              const TellLine& tell);

}  // namespace manzana::foliage

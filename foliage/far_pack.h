#pragma once
/// The pack of mosaics that far trees of a species are drawn by: about a second's work, without GL, on any thread.
///   const LdmPack pack = make_far_pack(plant);           // or load_or_make_far_pack() of foliage/import/ldm_cache.h
#include "foliage/ldm_pack.h"
#include "foliage/prepared_plant.h"

namespace manzana::foliage {

/// Pictures from this level on are all that trees so small ask for.
inline constexpr LdmOptions kFarPack{.nearest = 4};

LdmPack make_far_pack(const PreparedPlant& plant);

}  // namespace manzana::foliage

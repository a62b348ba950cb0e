#pragma once
/// Makes what far trees ask for, when they ask, beside what is drawn: packs of species, kept on disk; groves of blocks.
///   Packs packs(pack_maker(plants));
///   packs.want(renderer.packs_wanted());                              // each frame
///   while (auto made = packs.take()) renderer.add_pack(made->key, std::move(made->value));
#include "apps/walkthrough/background.h"
#include "foliage/grove.h"
#include "foliage/ldm_pack.h"
#include "scenegraph/draw/renderer.h"

namespace manzana::walkthrough {

using Packs = Background<std::uint32_t, foliage::LdmPack>;
using Groves = Background<draw::GroveWanted, foliage::Grove>;

/// The plants, and the renderer, must outlive what is made with it.
Packs::Make pack_maker(std::span<const foliage::PreparedPlant> plants);
Groves::Make grove_maker(std::span<const foliage::PreparedPlant> plants, const draw::Renderer& renderer);

}  // namespace manzana::walkthrough

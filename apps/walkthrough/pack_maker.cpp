#include "apps/walkthrough/pack_maker.h"

#include <cstdio>
#include <functional>

#include "foliage/gl/ldm_sampler.h"
#include "foliage/import/ldm_cache.h"
#include "foliage/make_ldm.h"
#include "gl/context.h"
#include "scenegraph/draw/far_trees.h"

namespace manzana::walkthrough {
namespace {

/// Far pictures have a quarter of the finest pixels a side: with 2 x 2 samples in each of those they have 64.
constexpr int kFine = 2;

void tell(const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); }

foliage::LdmPack make(const foliage::PreparedPlant& plant) {
  const auto sample = [&] {
    foliage::LdmSamplerGl sampler(plant, kFine);
    return make_ldm_pack(ldm_ball(plant), draw::kFarPack, std::ref(sampler));
  };
  return load_or_make_pack(plant, foliage::default_cache_folder(), draw::kFarPack, sample, tell);
}

}  // namespace

/// The context is the thread's own: GL of the one that draws is left alone.
Packs::Make pack_maker(std::span<const foliage::PreparedPlant> plants) {
  return [plants](std::uint32_t plant) -> std::optional<foliage::LdmPack> {
    thread_local std::optional<gl::HeadlessContext> context;
    try {
      if (!context) context.emplace();
      return make(plants[plant]);
    } catch (const std::exception& error) {
      tell(plants[plant].name + ": far trees stay as near ones are: " + error.what());
      return std::nullopt;
    }
  };
}

Groves::Make grove_maker(std::span<const foliage::PreparedPlant> plants, const draw::Renderer& renderer) {
  const auto maker = std::make_shared<foliage::GroveMaker>(plants);
  return [maker, &renderer](const draw::GroveWanted& wanted) -> std::optional<foliage::Grove> {
    return maker->make(renderer.trees_of(wanted.block), wanted.level);
  };
}

}  // namespace manzana::walkthrough

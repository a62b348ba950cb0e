#include "scenegraph/draw/far_tree_maker.h"

#include "scenegraph/draw/groves.h"

namespace manzana::draw {
namespace {

auto pack_task(const FarTreeSource& source, const FarTreeHow& how) {
  return [source, make = how.make_pack](std::uint32_t plant) { return make(source.plants[plant]); };
}

auto grove_task(const FarTreeSource& source) {
  return
      [source](const GroveWanted& wanted) { return std::optional(make_grove(source.plants, *source.sites, wanted)); };
}

}  // namespace

FarTreeMaker::FarTreeMaker(const FarTreeSource& source, const FarTreeHow& how)
    : packs_(pack_task(source, how), how.run, how.arrived), groves_(grove_task(source), how.run, how.arrived) {}

void FarTreeMaker::want(const Renderer& renderer) {
  for (const std::uint32_t plant : renderer.packs_wanted())
    if (!kept_.contains(plant)) packs_.want(plant);
  for (const GroveWanted& wanted : renderer.groves_wanted()) groves_.want(wanted);
}

/// One, to a renderer that is not the one it was made for.
bool FarTreeMaker::give_kept(Renderer& renderer) {
  for (const std::uint32_t plant : renderer.packs_wanted())
    if (auto kept = kept_.extract(plant)) return renderer.add_pack(plant, std::move(kept.mapped()));
  return false;
}

bool FarTreeMaker::give(Renderer& renderer, std::size_t most_bytes) {
  bool given = give_kept(renderer);
  if (!given)
    if (auto made = packs_.take()) given = renderer.add_pack(made->key, std::move(made->value));
  for (std::size_t bytes = 0; bytes < most_bytes;) {
    const auto made = groves_.take();
    if (!made) break;
    given = renderer.add_grove(made->key, made->value) || given;
    bytes += made->value.points.size() * sizeof(foliage::LeafPoint);
  }
  return given;
}

bool FarTreeMaker::give_all(Renderer& renderer) {
  bool given = false;
  while (give_kept(renderer)) given = true;
  while (auto made = packs_.wait_and_take()) given = renderer.add_pack(made->key, std::move(made->value)) || given;
  while (const auto made = groves_.wait_and_take()) given = renderer.add_grove(made->key, made->value) || given;
  return given;
}

}  // namespace manzana::draw

#pragma once
/// Makes what far trees ask for beside what is drawn, when they ask: packs of species, groves of blocks.
///   FarTreeMaker far({plants, renderer.sites()}, {.make_pack = make_far_pack});
///   ...each frame, the context current:
///   far.give(renderer, bytes_a_frame);                                // what has been made since
///   renderer.draw(...);
///   far.want(renderer);                                               // what was missing
/// GL is called by give() alone. It may outlive the renderer: another one, of the same scene and plants, is given its
/// packs.
///   far.keep(renderer);                                               // before that goes
#include <map>

#include "foliage/ldm_pack.h"
#include "scenegraph/draw/background.h"
#include "scenegraph/draw/renderer.h"

namespace manzana::draw {

struct FarTreeSource {
  std::span<const foliage::PreparedPlant> plants;
  std::shared_ptr<const std::vector<foliage::TreeSite>> sites;  ///< Renderer::sites()
  std::shared_ptr<const void> owner = {};                       ///< of the plants; none: they outlive every task
};

struct FarTreeHow {
  /// foliage/far_pack.h, or what is kept of it. None: the species' far trees stay as near ones are. Throws nothing.
  std::function<std::optional<foliage::LdmPack>(const foliage::PreparedPlant&)> make_pack;
  Run run = {};                        ///< none: a thread for packs, one for groves, while there are some to make
  std::function<void()> arrived = {};  ///< something can be given; from the task's thread, never after drop()
};

class FarTreeMaker {
 public:
  FarTreeMaker(const FarTreeSource& source, const FarTreeHow& how);

  /// What trees of the last picture were too small for: each is made once.
  void want(const Renderer& renderer);
  /// One pack at most, groves until so many bytes. True: the picture will be another.
  bool give(Renderer& renderer, std::size_t most_bytes);
  /// Waits for all that is wanted.
  bool give_all(Renderer& renderer);
  /// The packs of one that is about to go.
  void keep(Renderer& renderer) { kept_.merge(renderer.take_packs()); }
  /// Nothing that is wanted comes any more, until it is wanted again; may wait for what a thread of its own has at
  /// hand.
  void drop() { packs_.drop(), groves_.drop(); }
  bool ready() const { return packs_.ready() || groves_.ready(); }     ///< something waits for give()
  std::size_t left() const { return packs_.left() + groves_.left(); }  ///< wanted, and not given

 private:
  bool give_kept(Renderer& renderer);

  std::map<std::uint32_t, foliage::LdmPack> kept_;  ///< for the next renderer
  Background<std::uint32_t, foliage::LdmPack> packs_;
  Background<GroveWanted, foliage::Grove> groves_;
};

}  // namespace manzana::draw

#pragma once
/// Draws trees as packs of mosaics, lit by the host: what foliage/shaders/plant.glsl names, and HostShaders::mosaics.
///   LdmDrawer drawer(packs, std::make_shared<LdmPrograms>(host, host));
///   choose_ldm(drawer.store().table, seen, false, chosen);
///   drawer.draw_dithered(chosen, samples);
#include <memory>

#include "foliage/gl/draw_plants.h"
#include "foliage/gl/ldm_store.h"

namespace manzana::foliage {

/// What drawers share.
struct LdmPrograms {
  /// Throws std::runtime_error when a shader does not compile.
  LdmPrograms(const HostShaders& dithered_host, const HostShaders& blended_host);
  const gl::Program& dithered(int samples);

  HostShaders host;
  std::map<int, gl::Program> by_samples;  ///< made when first drawn with
  gl::Program blended, sum;
  gl::Buffer indices;
  gl::VertexArray array;
};

class LdmDrawer {
 public:
  /// The packs must outlive it. Throws std::runtime_error when the device has no room.
  LdmDrawer(std::span<const LdmPack> packs, std::shared_ptr<LdmPrograms> programs);

  const LdmStore& store() const { return store_; }

  /// Into the bound framebuffer, with its depth, in any order: every sample shows one side and level of a tree.
  void draw_dithered(const LdmSelection& chosen, int samples, const Wind& wind = {});

  /// [Zhang 2004] For comparison: each rank of the selection, which must be sorted, from back to front into a picture
  /// of its own; their sum over what is in the bound framebuffer, whose depth is neither asked nor changed. Where trees
  /// hide each other their weights need not sum to 1.
  void draw_blended(const LdmSelection& chosen, int width, int height);

 private:
  struct Layer {
    int width = 0, height = 0;
    gl::Texture colour;
    gl::Framebuffer framebuffer;
  };
  static Layer make_layer(int width, int height);
  void begin(const gl::Program& program, const LdmSelection& chosen);
  void draw(const Run& groups) const;
  void add_up(const Layer& from, GLuint to, GLenum times_behind) const;

  LdmStore store_;
  std::shared_ptr<LdmPrograms> programs_;
  gl::StreamBuffer stream_;
  Layer part_, all_;
};

}  // namespace manzana::foliage

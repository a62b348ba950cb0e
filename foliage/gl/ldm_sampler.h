#pragma once
/// What a plant's slabs show from a side, drawn by the GPU.
///   LdmSamplerGl sampler(plant);
///   make_ldm_pack(ldm_ball(plant), {}, std::ref(sampler));       // foliage/make_ldm.h
/// Leaves framebuffer, program, buffer bindings, depth and viewport state changed; waits for the GPU at each side.
#include "foliage/gl/plant_store.h"
#include "foliage/ldm_pack.h"
#include "gl/handle.h"

namespace manzana::foliage {

class LdmSamplerGl {
 public:
  /// Each pixel of a picture is the mean of `fine` x `fine`, at most 8. The source has one ray a pixel. The plant must
  /// stay as it is.
  explicit LdmSamplerGl(const PreparedPlant& plant, int fine = 4);
  /// A SampleLdm.
  LdmImage operator()(const ParallelView& view, int layers);

 private:
  void set_view(const ParallelView& view);
  std::vector<Run> sort_quads(const ParallelView& view, int layers);
  void draw_slab(const ParallelView& view, int layer, int layers, const Run& quads);
  void read_slab(int layer, LdmImage& image);

  int fine_, side_;
  const PreparedPlant& plant_;
  PlantStore store_;
  gl::Texture colour_, surface_, depth_;
  gl::Framebuffer framebuffer_;
  gl::Program program_;
  gl::VertexArray array_;
  gl::Buffer slab_quads_;
  std::vector<std::uint8_t> colours_, surfaces_;
};

}  // namespace manzana::foliage

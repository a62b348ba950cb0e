#pragma once
/// Packs of mosaics on the GPU, all packs in the same buffers and pictures.
#include <span>

#include "foliage/ldm_pack.h"
#include "foliage/ldm_select.h"
#include "gl/handle.h"

namespace manzana::foliage {

struct LdmStore {
  /// The packs must stay as they are. Throws std::runtime_error when the device has no room.
  explicit LdmStore(std::span<const LdmPack> packs);

  LdmTable table;
  gl::Buffer sides, blocks, mosaics;
  gl::Texture colours, surfaces;  ///< a layer a page, with the mip levels that a block has
};

}  // namespace manzana::foliage

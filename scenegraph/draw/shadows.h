#pragma once
/// Soft dark ground under cars and trees: one quad each, over the surfaces, by the instances that are drawn anyway.
#include "gl/program.h"
#include "scenegraph/draw/instances.h"

namespace manzana::draw {

struct Shadows {
  Shadows();
  gl::Program tree, car;
};

/// Multiplies what is drawn already. `array` is of a MeshSet whose instances are bound: total of `bins`.
Drawn draw_shadows(const gl::Program& program, const MeshSet& set, const InstanceBins& bins);

}  // namespace manzana::draw

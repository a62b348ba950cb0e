#pragma once
/// Visible cars on the GPU: instances of a few meshes, written each frame.
#include "gl/program.h"
#include "scenegraph/draw/car_model.h"
#include "scenegraph/draw/select_cars.h"

namespace manzana::draw {

struct CarLayerGpu {
  explicit CarLayerGpu(std::size_t cars);
  CarSelection selection;
  MeshSet meshes;
  gl::Program program;
};

/// After count_cars about the same cars.
Drawn draw_cars(CarLayerGpu& layer, const Scene& scene, std::span<const CarState> cars, const Vec3d& eye,
                gl::StreamBuffer& stream);

}  // namespace manzana::draw

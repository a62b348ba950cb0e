#pragma once
/// Visible cars on the GPU: instances of a few meshes, written each frame.
#include "gl/program.h"
#include "scenegraph/draw/car_model.h"
#include "scenegraph/draw/instances.h"
#include "scenegraph/scene.h"

namespace manzana::draw {

struct CarLayerGpu {
  explicit CarLayerGpu(std::size_t cars);
  InstanceBins bins;  ///< mesh of a body's level: body * kCarLevels + level
  std::vector<std::uint8_t> mesh_of;
  MeshSet meshes;
  gl::Program program;
};

/// `focal_px`: culling::projected_radius's, times the detail.
void count_cars(std::span<const CarState> cars, const Vec3d& eye, double focal_px, CarLayerGpu& layer);
Drawn draw_cars(CarLayerGpu& layer, const Scene& scene, std::span<const CarState> cars, const Vec3d& eye,
                gl::StreamBuffer& stream);

/// Where a car stands: `up` is its block's.
Instance place_car(const CarState& car, const Vec3d& up, const Vec3d& eye);

}  // namespace manzana::draw

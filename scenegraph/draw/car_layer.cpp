#include "scenegraph/draw/car_layer.h"

#include "manzana_draw_shaders.h"

namespace manzana::draw {
namespace {

MeshSet upload_meshes() {
  CarMesh all;
  std::vector<MeshRange> meshes;
  for (std::size_t i = 0; i < kCarBodies * kCarLevels; ++i) {
    const CarMesh mesh = make_car(static_cast<CarBody>(i / kCarLevels), i % kCarLevels);
    meshes.push_back({static_cast<std::uint32_t>(all.indices.size()), static_cast<std::uint32_t>(mesh.indices.size()),
                      static_cast<std::int32_t>(all.vertices.size())});
    all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    all.indices.insert(all.indices.end(), mesh.indices.begin(), mesh.indices.end());
  }
  return make_mesh_set(all.vertices, all.indices, meshes);
}

}  // namespace

CarLayerGpu::CarLayerGpu(std::size_t cars)
    : selection(cars),
      meshes(upload_meshes()),
      program(gl::make_program(
          "car", {shaders::version_glsl, shaders::frame_layout_glsl, shaders::frame_glsl, shaders::car_vert},
          {shaders::version_glsl, shaders::frame_layout_glsl, shaders::frame_glsl, shaders::light_glsl,
           shaders::share_glsl, shaders::car_frag})) {}

Drawn draw_cars(CarLayerGpu& layer, const Scene& scene, std::span<const CarState> cars, const Vec3d& eye,
                gl::StreamBuffer& stream) {
  const auto instances = stream.take<Instance>(layer.selection.bins.total());
  place_cars(scene, cars, eye, layer.selection, instances.items);
  glUseProgram(layer.program.name());
  return draw_instances(layer.meshes, layer.selection.bins, stream, instances.offset);
}

}  // namespace manzana::draw

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
  MeshSet set = make_mesh_set(std::as_bytes(std::span(all.vertices)), sizeof(CarVertex), all.indices, meshes);
  const GLuint array = set.array.name();
  for (GLuint attribute = 0; attribute < 3; ++attribute) {
    glEnableVertexArrayAttrib(array, attribute);
    glVertexArrayAttribBinding(array, attribute, 0);
  }
  glVertexArrayAttribFormat(array, 0, 3, GL_FLOAT, GL_FALSE, offsetof(CarVertex, position));
  glVertexArrayAttribFormat(array, 1, 4, GL_INT_2_10_10_10_REV, GL_TRUE, offsetof(CarVertex, normal));
  glVertexArrayAttribIFormat(array, 2, 1, GL_UNSIGNED_INT, offsetof(CarVertex, part));
  return set;
}

std::size_t level_of(double radius_px) {
  std::size_t level = 0;
  while (level + 1 < kCarLevels && radius_px < kCarMinRadiusPx[level]) ++level;
  return level;
}

}  // namespace

CarLayerGpu::CarLayerGpu(std::size_t cars)
    : bins(kCarBodies * kCarLevels),
      meshes(upload_meshes()),
      program(gl::make_program(
          "car", {shaders::version_glsl, shaders::frame_layout_glsl, shaders::frame_glsl, shaders::car_vert},
          {shaders::version_glsl, shaders::frame_layout_glsl, shaders::frame_glsl, shaders::light_glsl,
           shaders::car_frag})) {
  mesh_of.reserve(cars);
}

void count_cars(std::span<const CarState> cars, const Vec3d& eye, double focal_px, CarLayerGpu& layer) {
  layer.bins.clear();
  layer.mesh_of.clear();
  for (const CarState& car : cars) {
    const double radius_px = culling::projected_radius(kCarRadius, glm::distance(car.position, eye), focal_px);
    const std::size_t mesh = static_cast<std::size_t>(car_body(car.car)) * kCarLevels + level_of(radius_px);
    layer.mesh_of.push_back(static_cast<std::uint8_t>(mesh));
    ++layer.bins.count[mesh];
  }
}

Instance place_car(const CarState& car, const Vec3d& up, const Vec3d& eye) {
  const Vec3d right = glm::normalize(glm::cross(car.forward, up));
  const Vec3d top = glm::cross(right, car.forward);
  const Vec3d at = car.position - eye;
  Instance instance;
  for (int i = 0; i < 3; ++i) {
    instance.rows[static_cast<std::size_t>(i)] = Vec4(glm::dvec4(right[i], car.forward[i], top[i], at[i]));
  }
  instance.extra = Vec4(car_paint(car.car), 0);
  return instance;
}

Drawn draw_cars(CarLayerGpu& layer, const Scene& scene, std::span<const CarState> cars, const Vec3d& eye,
                gl::StreamBuffer& stream) {
  const auto instances = stream.take<Instance>(cars.size());
  layer.bins.start();
  for (std::size_t i = 0; i < cars.size(); ++i) {
    const std::uint32_t block = scene.traffic.halves[cars[i].half].block;
    instances.items[layer.bins.next[layer.mesh_of[i]]++] = place_car(cars[i], scene.blocks[block].axes[2], eye);
  }
  glUseProgram(layer.program.name());
  return draw_instances(layer.meshes, layer.bins, stream, instances.offset);
}

}  // namespace manzana::draw

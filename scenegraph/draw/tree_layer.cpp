#include "scenegraph/draw/tree_layer.h"

#include <cassert>
#include <stdexcept>

#include "manzana_draw_shaders.h"
#include "scenegraph/draw/leaf_texture.h"

namespace manzana::draw {
namespace {

constexpr int kImageSize = 256;
constexpr int kImageLevels = 9;

// What is left of a model once its content is on the GPU.
std::vector<foliage::PlantModel> outlines(std::span<const foliage::PlantModel> plants) {
  if (plants.size() < static_cast<std::size_t>(PlantKind::count)) {
    throw std::invalid_argument("a plant model for each PlantKind is needed");
  }
  std::vector<foliage::PlantModel> models;
  for (const foliage::PlantModel& plant : plants) {
    if (plant.levels.empty()) throw std::invalid_argument("plant model " + plant.name + " has no level");
    foliage::PlantModel& model = models.emplace_back();
    for (const foliage::PlantLevel& level : plant.levels)
      model.levels.emplace_back().min_radius_px = level.min_radius_px;
  }
  return models;
}

void describe_vertices(GLuint array) {
  using foliage::PlantVertex;
  for (GLuint attribute = 0; attribute < 4; ++attribute) {
    glEnableVertexArrayAttrib(array, attribute);
    glVertexArrayAttribBinding(array, attribute, 0);
  }
  glVertexArrayAttribFormat(array, 0, 3, GL_FLOAT, GL_FALSE, offsetof(PlantVertex, position));
  glVertexArrayAttribFormat(array, 1, 4, GL_INT_2_10_10_10_REV, GL_TRUE, offsetof(PlantVertex, normal));
  glVertexArrayAttribFormat(array, 2, 2, GL_UNSIGNED_SHORT, GL_TRUE, offsetof(PlantVertex, u));
  glVertexArrayAttribIFormat(array, 3, 2, GL_UNSIGNED_BYTE, offsetof(PlantVertex, shade));
}

MeshSet upload_meshes(std::span<const foliage::PlantModel> plants) {
  std::vector<foliage::PlantVertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<MeshRange> meshes;
  for (const foliage::PlantModel& plant : plants) {
    for (const foliage::PlantLevel& level : plant.levels) {
      meshes.push_back({static_cast<std::uint32_t>(indices.size()), static_cast<std::uint32_t>(level.indices.size()),
                        static_cast<std::int32_t>(vertices.size())});
      vertices.insert(vertices.end(), level.vertices.begin(), level.vertices.end());
      indices.insert(indices.end(), level.indices.begin(), level.indices.end());
    }
  }
  MeshSet set = make_mesh_set(std::as_bytes(std::span(vertices)), sizeof(foliage::PlantVertex), indices, meshes);
  describe_vertices(set.array.name());
  return set;
}

void upload_image(GLuint texture, GLint layer, const foliage::Image& image) {
  GLint level = 0;
  for (const foliage::Image& mip : coverage_mipmaps(resized(image, kImageSize))) {
    glTextureSubImage3D(texture, level++, 0, 0, layer, mip.size, mip.size, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                        mip.rgba.data());
  }
}

gl::Texture upload_textures(std::span<const foliage::PlantModel> plants) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &name);
  gl::Texture texture(name);
  // sRGB values, decoded after filtering: software devices decode four texels a sample otherwise.
  glTextureStorage3D(name, kImageLevels, GL_RGBA8, kImageSize, kImageSize, 2 * static_cast<GLsizei>(plants.size()));
  for (std::size_t i = 0; i < plants.size(); ++i) {
    upload_image(name, 2 * static_cast<GLint>(i), plants[i].bark);
    upload_image(name, 2 * static_cast<GLint>(i) + 1, plants[i].leaf);
  }
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return texture;
}

}  // namespace

TreeLayerGpu::TreeLayerGpu(std::size_t trees, std::span<const foliage::PlantModel> plants, const Quality& quality)
    : models(outlines(plants)),
      selection(trees, models),
      meshes(upload_meshes(plants)),
      textures(upload_textures(plants)),
      program(gl::make_program("tree",
                               {shaders::version_glsl, shaders::frame_layout_glsl, shaders::frame_glsl,
                                shaders::light_glsl, shaders::tree_vert},
                               {shaders::version_glsl, shaders::frame_layout_glsl, shaders::frame_glsl,
                                shaders::light_glsl, shaders::tree_frag})) {
  glProgramUniform1f(program.name(), 0, quality.samples > 1 ? 1.0F : 0.0F);
}

Drawn draw_trees(TreeLayerGpu& layer, const TreeLayer& trees, std::span<const culling::ObjectRun> objects,
                 std::span<const Rows> blocks, gl::StreamBuffer& stream, bool alpha_to_coverage) {
  const auto instances = stream.take<Instance>(layer.selection.bins.total());
  place_trees(trees, objects, blocks, layer.selection, instances.items);
  glUseProgram(layer.program.name());
  glBindTextureUnit(0, layer.textures.name());
  if (alpha_to_coverage) glEnable(GL_SAMPLE_ALPHA_TO_COVERAGE);
  const Drawn drawn = draw_instances(layer.meshes, layer.selection.bins, stream, instances.offset);
  glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
  return drawn;
}

}  // namespace manzana::draw

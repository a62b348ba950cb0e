#include "foliage/gl/plant_store.h"

#include <array>
#include <cassert>

#include "foliage/leaf_texture.h"
#include "gl/buffer.h"

namespace manzana::foliage {
namespace {

constexpr int kImageSize = 256;
constexpr int kImageLevels = 9;
constexpr std::array<std::uint8_t, 4> kWhite{255, 255, 255, 255};

template <class T>
gl::Buffer upload(const std::vector<T>& content) {
  return gl::make_buffer(std::as_bytes(std::span(content)));
}

/// Of all plants, one after the other.
template <class T>
void append(std::vector<T>& all, const std::vector<T>& part) {
  all.insert(all.end(), part.begin(), part.end());
}

/// Plant by plant, the lists of each one after the other.
template <class T>
gl::Buffer upload_all(std::span<const PreparedPlant> plants,
                      std::initializer_list<std::vector<T> PreparedPlant::*> members) {
  std::size_t size = 0;
  for (const PreparedPlant& plant : plants)
    for (const auto member : members) size += (plant.*member).size();
  std::vector<T> all;
  all.reserve(size);
  for (const PreparedPlant& plant : plants)
    for (const auto member : members) append(all, plant.*member);
  return upload(all);
}

/// White where there is none.
void upload_image(GLuint texture, GLint layer, const Image& image) {
  GLint level = 0;
  for (; image.size == 0 && level < kImageLevels; ++level)
    glClearTexSubImage(texture, level, 0, 0, layer, kImageSize >> level, kImageSize >> level, 1, GL_RGBA,
                       GL_UNSIGNED_BYTE, kWhite.data());
  if (image.size == 0) return;
  for (const Image& mip : coverage_mipmaps(resized(image, kImageSize))) {
    glTextureSubImage3D(texture, level++, 0, 0, layer, mip.size, mip.size, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                        mip.rgba.data());
  }
}

gl::Texture upload_images(std::span<const PreparedPlant> plants) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &name);
  gl::Texture texture(name);
  // sRGB values, decoded after filtering: software devices decode four texels a sample otherwise.
  glTextureStorage3D(name, kImageLevels, GL_RGBA8, kImageSize, kImageSize, 2 * static_cast<GLsizei>(plants.size()));
  for (std::size_t i = 0; i < plants.size(); ++i) {
    upload_image(name, 2 * static_cast<GLint>(i), plants[i].bark_image);
    upload_image(name, 2 * static_cast<GLint>(i) + 1, plants[i].leaf_image);
  }
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return texture;
}

}  // namespace

PlantStore::PlantStore(std::span<const PreparedPlant> prepared)
    : table(make_plant_table(prepared)),
      plants(upload(table.plants)),
      cells(upload(table.cells)),
      steps(upload(table.steps)),
      details(gl::make_buffer(prepared.size() * glsl::kDetailSteps * sizeof(Detail))),
      views(upload(table.views)),
      quads(upload_all(prepared, {&PreparedPlant::bark, &PreparedPlant::leaves})),
      lines(upload_all(prepared, {&PreparedPlant::lines, &PreparedPlant::coarse_lines})),
      points(upload_all(prepared, {&PreparedPlant::points})),
      images(upload_images(prepared)) {}

void set_details(PlantStore& store, std::vector<Detail> details) {
  assert(details.size() == store.table.plants.size() * glsl::kDetailSteps);
  store.table.details = std::move(details);
  glNamedBufferSubData(store.details.name(), 0, static_cast<GLsizeiptr>(store.table.details.size() * sizeof(Detail)),
                       store.table.details.data());
}

void bind(const PlantStore& store) {
  const auto to = [](GLuint binding, const gl::Buffer& buffer) {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.name());
  };
  to(kPlantsBinding, store.plants);
  to(kCellsBinding, store.cells);
  to(kStepsBinding, store.steps);
  to(kDetailsBinding, store.details);
  to(kViewsBinding, store.views);
}

}  // namespace manzana::foliage

#include "foliage/gl/ldm_store.h"

#include <algorithm>

#include "gl/buffer.h"

namespace manzana::foliage {
namespace {

template <class T>
gl::Buffer upload_all(std::span<const LdmPack> packs, std::vector<T> LdmPack::*member) {
  std::vector<T> all;
  for (const LdmPack& pack : packs) all.insert(all.end(), (pack.*member).begin(), (pack.*member).end());
  return gl::make_buffer(std::as_bytes(std::span(all)));
}

gl::Texture make_texture(std::size_t pages, GLenum filter, GLenum magnified) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &name);
  gl::Texture texture(name);
  glTextureStorage3D(name, 1 + kLdmShrinks, GL_RGBA8, kLdmPage, kLdmPage,
                     static_cast<GLsizei>(std::max<std::size_t>(pages, 1)));
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, static_cast<GLint>(filter));
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, static_cast<GLint>(magnified));
  return texture;
}

std::size_t pages_of(std::span<const LdmPack> packs) {
  std::size_t pages = 0;
  for (const LdmPack& pack : packs) pages += pack.pages();
  return pages;
}

void upload_pages(std::span<const LdmPack> packs, std::vector<std::uint8_t> LdmPack::*half,
                  const gl::Texture& texture) {
  std::size_t first = 0;
  for (const LdmPack& pack : packs) {
    for (int level = 0; level <= kLdmShrinks; ++level)
      glTextureSubImage3D(texture.name(), level, 0, 0, static_cast<GLint>(first), kLdmPage >> level, kLdmPage >> level,
                          static_cast<GLsizei>(pack.pages()), GL_RGBA, GL_UNSIGNED_BYTE,
                          (pack.*half).data() + pack.level_begin(level));
    first += pack.pages();
  }
}

}  // namespace

LdmStore::LdmStore(std::span<const LdmPack> packs)
    : table(make_ldm_table(packs)),
      sides(gl::make_buffer(std::as_bytes(std::span(table.sides)))),
      blocks(upload_all(packs, &LdmPack::blocks)),
      mosaics(upload_all(packs, &LdmPack::mosaics)) {
  const std::size_t pages = pages_of(packs);
  colours = make_texture(pages, GL_LINEAR_MIPMAP_NEAREST, GL_LINEAR);
  surfaces = make_texture(pages, GL_NEAREST_MIPMAP_NEAREST, GL_NEAREST);
  upload_pages(packs, &LdmPack::colour, colours);
  upload_pages(packs, &LdmPack::surface, surfaces);
}

}  // namespace manzana::foliage

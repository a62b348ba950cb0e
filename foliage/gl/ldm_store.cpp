#include "foliage/gl/ldm_store.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "foliage/ldm_texture.h"
#include "gl/buffer.h"

namespace manzana::foliage {
namespace {

template <class T>
gl::Buffer upload_all(std::span<const LdmPack> packs, std::vector<T> LdmPack::*member) {
  std::vector<T> all;
  for (const LdmPack& pack : packs) all.insert(all.end(), (pack.*member).begin(), (pack.*member).end());
  return gl::make_buffer(std::as_bytes(std::span(all)));
}

LdmSquare page_of(const LdmPack& pack, std::size_t page) {
  constexpr std::size_t kTexels = std::size_t{kLdmPage} * kLdmPage;
  LdmSquare square{kLdmPage, {}};
  square.texels.reserve(kTexels);
  for (std::size_t i = page * kTexels; i < (page + 1) * kTexels; ++i) {
    const std::uint8_t *c = &pack.colour[4 * i], *s = &pack.surface[4 * i];
    square.texels.push_back({{c[0], c[1], c[2], c[3]}, s[0], s[1], s[2], s[3]});
  }
  return square;
}

/// Levels of each page, finest first.
std::vector<std::vector<LdmSquare>> pages_of(std::span<const LdmPack> packs) {
  std::vector<std::pair<const LdmPack*, std::size_t>> sources;
  for (const LdmPack& pack : packs)
    for (std::size_t page = 0; page < pack.pages(); ++page) sources.emplace_back(&pack, page);
  std::vector<std::vector<LdmSquare>> pages(sources.size());
  tbb::parallel_for(std::size_t{0}, pages.size(), [&](std::size_t i) {
    pages[i] = {page_of(*sources[i].first, sources[i].second)};
    while (pages[i].size() <= kLdmShrinks) pages[i].push_back(halved(pages[i].back()));
  });
  return pages;
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

void upload_pages(const std::vector<std::vector<LdmSquare>>& pages, const gl::Texture& colours,
                  const gl::Texture& surfaces) {
  for (std::size_t page = 0; page < pages.size(); ++page)
    for (std::size_t level = 0; level < pages[page].size(); ++level) {
      const LdmSquare& square = pages[page][level];
      std::vector<std::uint8_t> colour, surface;
      for (const LdmTexel& t : square.texels) {
        colour.insert(colour.end(), t.colour.begin(), t.colour.end());
        surface.insert(surface.end(), {t.normal_x, t.normal_y, t.depth, t.shade});
      }
      const auto upload = [&](const gl::Texture& texture, const std::vector<std::uint8_t>& bytes) {
        glTextureSubImage3D(texture.name(), static_cast<GLint>(level), 0, 0, static_cast<GLint>(page), square.side,
                            square.side, 1, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
      };
      upload(colours, colour);
      upload(surfaces, surface);
    }
}

}  // namespace

LdmStore::LdmStore(std::span<const LdmPack> packs)
    : table(make_ldm_table(packs)),
      sides(gl::make_buffer(std::as_bytes(std::span(table.sides)))),
      blocks(upload_all(packs, &LdmPack::blocks)),
      mosaics(upload_all(packs, &LdmPack::mosaics)) {
  const auto pages = pages_of(packs);
  colours = make_texture(pages.size(), GL_LINEAR_MIPMAP_NEAREST, GL_LINEAR);
  surfaces = make_texture(pages.size(), GL_NEAREST_MIPMAP_NEAREST, GL_NEAREST);
  upload_pages(pages, colours, surfaces);
}

}  // namespace manzana::foliage

#include "scenegraph/draw/picture_pages.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace manzana::draw {
namespace {

constexpr GLuint kPagesUnit = 0, kWornBinding = 0;
constexpr std::uint32_t kLeastSide = 8, kLeastPage = 256;
constexpr double kFilled = 0.75;            // of all pages, by what is seen: squares leave gaps
constexpr std::uint64_t kRefusedFor = 600;  // pictures

std::size_t bytes_of_page(std::uint32_t side) { return std::size_t{side} * side * sizeof(GroundPhoto::Texel) / 3 * 4; }

std::uint32_t page_side(const Pictures& pictures, std::size_t most_bytes) {
  std::uint32_t side = kLeastPage;
  for (const EncodedPicture& picture : pictures.encoded) side = std::max(side, side_of(picture));
  while (side > kLeastSide && bytes_of_page(side) > most_bytes) side /= 2;
  return side;
}

std::uint32_t most_pages(std::uint32_t side, std::size_t most_bytes) {
  GLint layers = 0;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &layers);
  const std::size_t pages = std::max<std::size_t>(1, most_bytes / bytes_of_page(side));
  return static_cast<std::uint32_t>(std::min(pages, static_cast<std::size_t>(layers)));
}

GLsizei levels_of(std::uint32_t side) { return std::bit_width(side); }
GLsizei at_level(std::uint32_t texels, GLsizei level) { return static_cast<GLsizei>(texels >> level); }

gl::Texture make_pages(std::uint32_t side, std::uint32_t pages) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &name);
  gl::Texture array(name);
  glTextureStorage3D(name, levels_of(side), GL_SRGB8_ALPHA8, static_cast<GLsizei>(side), static_cast<GLsizei>(side),
                     static_cast<GLsizei>(pages));
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  return array;
}

/// `skip`: of the first's finest levels, which the other does not have.
void copy(GLuint from, const Square& first, GLuint to, const Square& second, GLsizei skip) {
  for (GLsizei level = 0; level < levels_of(second.side); ++level) {
    const auto at = [](std::uint32_t texels, GLsizei l) { return static_cast<GLint>(texels >> l); };
    glCopyImageSubData(from, GL_TEXTURE_2D_ARRAY, level + skip, at(first.x, level + skip), at(first.y, level + skip),
                       static_cast<GLint>(first.page), to, GL_TEXTURE_2D_ARRAY, level, at(second.x, level),
                       at(second.y, level), static_cast<GLint>(second.page), at_level(second.side, level),
                       at_level(second.side, level), 1);
  }
}

/// Without the finest levels of the square, if the place is smaller.
void upload(const gl::Texture& pages, const Square& place, const PictureSquare& square) {
  const GLsizei skip = levels_of(square.front().columns) - levels_of(place.side);
  for (GLsizei level = 0; level < levels_of(place.side); ++level)
    glTextureSubImage3D(pages.name(), level, at_level(place.x, level), at_level(place.y, level),
                        static_cast<GLint>(place.page), at_level(place.side, level), at_level(place.side, level), 1,
                        GL_RGBA, GL_UNSIGNED_BYTE, square[static_cast<std::size_t>(level + skip)].texels.data());
}

std::uint32_t side_for(double pixels, std::uint32_t full) {
  if (!(pixels < full)) return full;
  return std::min(full, std::max(kLeastSide, std::bit_ceil(static_cast<std::uint32_t>(std::ceil(pixels)))));
}

}  // namespace

PicturePages::PicturePages(const Pictures& pictures, std::size_t most_bytes)
    : rows_(pictures.encoded.size()),
      textures_(pictures.textures),
      room_(page_side(pictures, most_bytes)),
      most_pages_(most_pages(room_.side(), most_bytes)),
      pages_(make_pages(1, 1)),
      worn_(gl::make_buffer(pictures.textures.size() * sizeof(glsl::WornData))) {
  for (std::size_t p = 0; p < rows_.size(); ++p) {
    const EncodedPicture& picture = pictures.encoded[p];
    const PicturePart& worn = picture.worn;
    const Vec2d all(picture.width, picture.height), part(worn.width, worn.height);
    const Vec2d low = Vec2d(worn.left, picture.height - worn.top - worn.height) / all;
    rows_[p].full = std::min(room_.side(), side_of(picture));
    rows_[p].share = std::max(part.x / all.x, part.y / all.y);
    rows_[p].part = Vec4(Vec2(low), Vec2(all / part));
  }
  for (std::uint32_t t = 0; t < textures_.size(); ++t) rows_[textures_[t].picture].textures.push_back(t);
  in_sight_.reserve(rows_.size());
  wanted_.reserve(rows_.size());
}

std::size_t PicturePages::device_bytes() const {
  return room_.pages() * bytes_of_page(room_.side()) + textures_.size() * sizeof(glsl::WornData);
}

void PicturePages::begin() {
  ++now_;
  in_sight_.clear();
  wanted_.clear();
}

void PicturePages::see(std::uint32_t picture, double pixels) {
  Row& row = rows_[picture];
  const std::uint32_t side = side_for(pixels * row.share, row.full);
  if (row.seen != now_) in_sight_.push_back(picture), row.need = 0;
  row.seen = now_;
  row.need = std::max(row.need, side);
}

/// Where all would need more than there is, each has half the side, until it fits.
void PicturePages::end() {
  double texels = 0;
  for (const std::uint32_t p : in_sight_) texels += static_cast<double>(rows_[p].need) * rows_[p].need;
  const double room = kFilled * most_pages_ * room_.side() * room_.side();
  std::uint32_t coarser = 0;
  for (; texels > room && coarser < 31; texels /= 4) ++coarser;
  for (const std::uint32_t p : in_sight_) {
    Row& row = rows_[p];
    row.need = std::max(row.need >> coarser, std::min(kLeastSide, row.full));
    const bool waits = row.refused > 0 && now_ - row.refused < kRefusedFor;
    if (!waits && (!row.held || row.held->side < row.need)) wanted_.push_back({p, row.need});
  }
}

bool PicturePages::add(const PictureWanted& wanted, const PictureSquare& square) {
  Row& row = rows_[wanted.picture];
  const std::uint32_t side = square.front().columns;
  if (row.held && row.held->side >= side) return false;
  if (side > room_.side()) return false;
  release(row);
  for (std::uint32_t fits = side; !row.held && fits > 0; fits /= 2) row.held = place(fits);
  row.refused = row.held && row.held->side == side ? 0 : now_;
  if (row.held) upload(pages_, *row.held, square);
  tell(row);
  return row.held.has_value();
}

std::optional<Square> PicturePages::place(std::uint32_t side) {
  for (;;) {
    if (const auto square = room_.take(side)) return square;
    if (!grow() && !make_room()) return {};
  }
}

bool PicturePages::grow() {
  const std::uint32_t before = room_.pages(), after = std::min(most_pages_, before + std::max(1U, before / 2));
  if (after == before) return false;
  gl::Texture larger = make_pages(room_.side(), after);
  for (std::uint32_t page = 0; page < before; ++page) {
    const Square all{page, 0, 0, room_.side()};
    copy(pages_.name(), all, larger.name(), all, 0);
  }
  pages_ = std::move(larger);
  room_.grow(after);
  return true;
}

/// What was not seen for longest goes; if all is in sight, what is finer than it must be becomes coarser.
bool PicturePages::make_room() {
  Row* oldest = nullptr;
  Row* finest = nullptr;
  for (Row& row : rows_) {
    if (!row.held) continue;
    if (row.seen < now_ && (oldest == nullptr || row.seen < oldest->seen)) oldest = &row;
    if (row.held->side > row.need && (finest == nullptr || row.held->side > finest->held->side)) finest = &row;
  }
  if (oldest != nullptr) return release(*oldest), tell(*oldest), true;
  if (finest != nullptr) return shrink(*finest), true;
  return false;
}

void PicturePages::release(Row& row) {
  if (row.held) room_.give(*row.held);
  row.held.reset();
}

/// Its levels move down by one or more: the place that is freed has room for them, and each is read before it is
/// written over.
void PicturePages::shrink(Row& row) {
  const Square before = *row.held;
  release(row);
  row.held = room_.take(row.need);
  copy(pages_.name(), before, pages_.name(), *row.held, levels_of(before.side) - levels_of(row.need));
  tell(row);
}

void PicturePages::tell(const Row& row) const {
  for (const std::uint32_t t : row.textures) {
    glsl::WornData data{};
    if (row.held) {
      const auto page = static_cast<float>(room_.side());
      const Square& s = *row.held;
      data.place = Vec4(static_cast<float>(s.x) / page, static_cast<float>(s.y) / page,
                        static_cast<float>(s.side) / page, static_cast<float>(levels_of(s.side) - 1));
      data.part = row.part;
      data.how = {s.page + 1, static_cast<std::uint32_t>(textures_[t].wrap), textures_[t].border, 0};
    }
    glNamedBufferSubData(worn_.name(), static_cast<GLintptr>(t * sizeof data), sizeof data, &data);
  }
}

void PicturePages::bind() const {
  glBindTextureUnit(kPagesUnit, pages_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kWornBinding, worn_.name());
}

void see(PicturePages& pages, const Scene& scene, const LayerPieces& buildings, const MeshDetail& detail) {
  std::uint32_t row = ~0U;
  double pixel = 0;
  const auto see_worn = [&](const Worn& worn) {
    if (std::exchange(row, worn.row) != worn.row)
      pixel = distance(detail, box_of(scene.buildings.table, row, scene.tree.origin)) * detail.pixel_at_1m;
    const Texture& texture = scene.pictures.textures[worn.texture - 1];
    pages.see(texture.picture, static_cast<double>(worn.metres) / pixel);
  };
  for (const std::uint32_t piece : buildings.in_sight)
    for (const std::uint32_t item : {buildings.shown[piece].item, buildings.shown[piece].next})
      if (buildings.held[item]) std::ranges::for_each(buildings.held[item]->worn, see_worn);
}

}  // namespace manzana::draw

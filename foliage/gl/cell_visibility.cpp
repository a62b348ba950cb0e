#include "foliage/gl/cell_visibility.h"

#include <algorithm>
#include <array>

#include "foliage/gl/plant_store.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/vertex_array.h"
#include "manzana_foliage_gl_shaders.h"

namespace manzana::foliage {
namespace {

constexpr GLuint kCellOfQuadsBinding = 0, kTilesBinding = 1, kCountsBinding = 2;
constexpr int kSheet = 2048;  // pixels a side of what cells are drawn apart into
constexpr GLuint kNobody = ~0U;

struct Tile {
  glm::ivec4 box, move;
};

gl::Buffer upload_quads(const PreparedPlant& plant) {
  std::vector<PlantQuad> quads = plant.leaves;
  quads.insert(quads.end(), plant.bark.begin(), plant.bark.end());
  return gl::make_buffer(std::as_bytes(std::span(quads)));
}

gl::Buffer upload_cells(const PreparedPlant& plant) {
  std::vector<std::uint32_t> cell_of(plant.leaves.size() + plant.bark.size(),
                                     static_cast<std::uint32_t>(plant.cells.size()));
  for (std::uint32_t c = 0; c < plant.cells.size(); ++c)
    std::fill(cell_of.begin() + plant.cells[c].quads.first, cell_of.begin() + plant.cells[c].quads.last, c);
  return gl::make_buffer(std::as_bytes(std::span(cell_of)));
}

gl::Texture make_texture(GLenum format, int side) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &name);
  gl::Texture texture(name);
  glTextureStorage2D(name, 1, format, side, side);
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return texture;
}

/// 1 where a leaf's picture is leaf.
gl::Texture upload_opaque(const Image& image) {
  std::vector<std::uint8_t> opaque;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) opaque.push_back(image.rgba[i] >= 128 ? 1 : 0);
  if (opaque.empty()) opaque.push_back(1);
  const int side = std::max(image.size, 1);
  gl::Texture texture = make_texture(GL_R8UI, side);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(texture.name(), 0, 0, 0, side, side, GL_RED_INTEGER, GL_UNSIGNED_BYTE, opaque.data());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  return texture;
}

void set_scissor(const PixelBox& box) {
  glScissor(box.low.x, box.low.y, box.high.x - box.low.x, box.high.y - box.low.y);
}

/// Occlusion queries, one after the other.
class Queries {
 public:
  explicit Queries(std::size_t n) : names_(n) {
    glCreateQueries(GL_SAMPLES_PASSED, static_cast<GLsizei>(n), names_.data());
  }
  ~Queries() { glDeleteQueries(static_cast<GLsizei>(names_.size()), names_.data()); }
  Queries(const Queries&) = delete;
  Queries& operator=(const Queries&) = delete;

  template <class Draw>
  void count(std::size_t i, Draw&& draw) const {
    glBeginQuery(GL_SAMPLES_PASSED, names_[i]);
    draw();
    glEndQuery(GL_SAMPLES_PASSED);
  }
  std::uint32_t result(std::size_t i) const {
    GLuint samples = 0;
    glGetQueryObjectuiv(names_[i], GL_QUERY_RESULT, &samples);
    return samples;
  }

 private:
  std::vector<GLuint> names_;
};

/// Places for boxes in a square, row by row.
class Shelves {
 public:
  explicit Shelves(int side) : side_(side) {}
  /// Nothing when the square is full.
  std::optional<glm::ivec2> place(const glm::ivec2& size) {
    if (next_.x + size.x > side_) next_ = {0, top_};
    if (next_.y + size.y > side_) return std::nullopt;
    const glm::ivec2 at = next_;
    next_.x += size.x;
    top_ = std::max(top_, at.y + size.y);
    used_ = std::max({used_, next_.x, top_});
    return at;
  }
  int used() const { return used_; }  ///< of the square's side

 private:
  int side_, top_ = 0, used_ = 0;
  glm::ivec2 next_{0};
};

}  // namespace

CellCounterGl::CellCounterGl(const PreparedPlant& plant, CountBy by)
    : by_(by),
      cells_(static_cast<std::uint32_t>(plant.cells.size())),
      leaves_(static_cast<std::uint32_t>(plant.leaves.size())),
      pieces_(pieces_of(plant)),
      quads_(upload_quads(plant)),
      cell_of_(upload_cells(plant)),
      tiles_(gl::make_buffer(plant.cells.size() * sizeof(Tile))),
      counts_(gl::make_buffer(2 * plant.cells.size() * sizeof(GLuint))),
      opaque_(upload_opaque(plant.leaf_image)),
      draw_(gl::make_program("cell_ids", {shaders::version_glsl, shaders::plant_quad_glsl, shaders::cell_ids_vert},
                             {shaders::version_glsl, shaders::cell_ids_frag})),
      histogram_(gl::make_compute_program("count_ids", {shaders::version_glsl, shaders::count_ids_comp})),
      array_(gl::make_vertex_array()) {}

CellCounterGl::Picture CellCounterGl::make_picture(int side) {
  Picture picture{side, make_texture(GL_R32UI, side), make_texture(GL_DEPTH_COMPONENT32F, side), {}};
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  picture.framebuffer = gl::Framebuffer(name);
  glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, picture.ids.name(), 0);
  glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, picture.depth.name(), 0);
  return picture;
}

void CellCounterGl::make_room(int side) {
  if (all_.side < side) all_ = make_picture(side);
  if (apart_.side < std::max(side, kSheet)) apart_ = make_picture(std::max(side, kSheet));
}

Run CellCounterGl::in_buffer(const CellPiece& piece) const {
  const std::uint32_t first = is_leaf(piece) ? 0 : leaves_;
  return {first + piece.quads.first, first + piece.quads.last};
}

std::vector<CellPiece> CellCounterGl::pieces_in(const ParallelView& view) const {
  std::vector<CellPiece> in;
  for (const CellPiece& piece : pieces_)
    if (!pixels_of(piece, view).empty()) in.push_back(piece);
  return in;
}

void CellCounterGl::set_view(const ParallelView& view) {
  const GLuint program = draw_.name();
  glProgramUniform3fv(program, 0, 1, &view.centre().x);
  glProgramUniform3fv(program, 1, 1, &view.right().x);
  glProgramUniform3fv(program, 2, 1, &view.up().x);
  glProgramUniform3fv(program, 3, 1, &view.towards().x);
  glProgramUniform2f(program, 4, view.pixels_of(1), view.radius());
  glProgramUniform1ui(program, 7, cells_);
  glBindVertexArray(array_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kPrimitivesBinding, quads_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kCellOfQuadsBinding, cell_of_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kTilesBinding, tiles_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kCountsBinding, counts_.name());
  glBindTextureUnit(0, opaque_.name());
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  for (const GLenum off : {GL_BLEND, GL_CULL_FACE, GL_SAMPLE_ALPHA_TO_COVERAGE, GL_POLYGON_OFFSET_FILL}) glDisable(off);
  glEnable(GL_SCISSOR_TEST);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
}

/// A picture with nobody in its first `pixels` a side, to be drawn into.
void CellCounterGl::begin(const Picture& picture, int pixels, bool apart) {
  const float farthest = 1;
  const std::array<GLuint, 4> nobody{kNobody, 0, 0, 0};
  glBindFramebuffer(GL_FRAMEBUFFER, picture.framebuffer.name());
  glViewport(0, 0, picture.side, picture.side);
  glScissor(0, 0, pixels, pixels);
  glClearNamedFramebufferuiv(picture.framebuffer.name(), GL_COLOR, 0, nobody.data());
  glClearNamedFramebufferfv(picture.framebuffer.name(), GL_DEPTH, 0, &farthest);
  glUseProgram(draw_.name());
  glUniform1i(6, apart ? 1 : 0);
}

/// Neighbours in the buffer go in one draw.
void CellCounterGl::draw(std::span<const CellPiece> pieces) const {
  constexpr GLint kVertices = 6;
  std::vector<GLint> first;
  std::vector<GLsizei> count;
  GLint last = -1;
  for (const CellPiece& piece : pieces) {
    const Run run = in_buffer(piece);
    const auto begin = kVertices * static_cast<GLint>(run.first);
    if (begin != last) first.push_back(begin), count.push_back(0);
    count.back() += kVertices * static_cast<GLsizei>(run.size());
    last = kVertices * static_cast<GLint>(run.last);
  }
  glMultiDrawArrays(GL_TRIANGLES, first.data(), count.data(), static_cast<GLsizei>(first.size()));
}

void CellCounterGl::count_ids(const Picture& picture, int pixels, std::uint32_t first) const {
  glBindTextureUnit(1, picture.ids.name());
  glUseProgram(histogram_.name());
  const auto side = static_cast<GLuint>(pixels);
  glUniform4ui(0, side, cells_, first, 0);
  glDispatchCompute((side + 15) / 16, (side + 15) / 16, 1);
}

/// As many cells in a sheet as there is room for.
void CellCounterGl::count_apart(std::span<const CellPiece> cells, const ParallelView& view) {
  for (std::size_t first = 0; first < cells.size();) {
    Shelves shelves(apart_.side);
    std::size_t last = first;
    for (; last < cells.size(); ++last) {
      const PixelBox box = pixels_of(cells[last], view);
      const auto at = shelves.place(box.high - box.low);
      if (!at) break;
      const glm::ivec2 move = *at - box.low;
      const Tile tile{{*at, box.high + move}, {move, 0, 0}};
      glNamedBufferSubData(tiles_.name(), static_cast<GLintptr>(cells[last].cell * sizeof tile), sizeof tile, &tile);
    }
    begin(apart_, shelves.used(), true);
    draw(cells.subspan(first, last - first));
    count_ids(apart_, shelves.used(), 0);
    first = last;
  }
}

CellPixels CellCounterGl::counted() const {
  CellPixels count;
  const auto bytes = static_cast<GLsizeiptr>(cells_ * sizeof(GLuint));
  count.own.resize(cells_);
  count.seen.resize(cells_);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(counts_.name(), 0, bytes, count.own.data());
  glGetNamedBufferSubData(counts_.name(), bytes, bytes, count.seen.data());
  return count;
}

void CellCounterGl::count_by_ids(std::span<const CellPiece> own, std::span<const CellPiece> all,
                                 const ParallelView& view) {
  glClearNamedBufferData(counts_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
  glProgramUniform2i(draw_.name(), 5, view.pixels(), all_.side);
  begin(all_, view.pixels(), false);
  draw(all);
  count_ids(all_, view.pixels(), cells_);
  glProgramUniform2i(draw_.name(), 5, view.pixels(), apart_.side);
  glDisable(GL_DEPTH_TEST);
  count_apart(own, view);
}

CellPixels CellCounterGl::count_by_queries(std::span<const CellPiece> own, std::span<const CellPiece> all,
                                           const ParallelView& view) {
  glProgramUniform2i(draw_.name(), 5, view.pixels(), all_.side);
  const Queries alone(own.size()), among(own.size());
  const Picture& other = apart_;
  glProgramUniform2i(draw_.name(), 5, view.pixels(), other.side);
  begin(other, view.pixels(), false);
  const float farthest = 1;
  for (std::size_t i = 0; i < own.size(); ++i) {
    set_scissor(pixels_of(own[i], view));
    glDepthMask(GL_TRUE);
    glClearNamedFramebufferfv(other.framebuffer.name(), GL_DEPTH, 0, &farthest);
    draw(own.subspan(i, 1));
    glDepthMask(GL_FALSE);
    alone.count(i, [&] { draw(own.subspan(i, 1)); });
  }
  glDepthMask(GL_TRUE);
  glProgramUniform2i(draw_.name(), 5, view.pixels(), all_.side);
  begin(all_, view.pixels(), false);
  draw(all);
  glDepthMask(GL_FALSE);
  for (std::size_t i = 0; i < own.size(); ++i) among.count(i, [&] { draw(own.subspan(i, 1)); });
  glDepthMask(GL_TRUE);
  CellPixels count{std::vector<std::uint32_t>(cells_), std::vector<std::uint32_t>(cells_), {}};
  for (std::size_t i = 0; i < own.size(); ++i) {
    count.own[own[i].cell] = alone.result(i);
    count.seen[own[i].cell] = among.result(i);
  }
  return count;
}

CellPixels CellCounterGl::operator()(const ParallelView& view, std::optional<std::uint32_t> only) {
  CellPixels count = count_from_front(view, only);
  count.seen_from_behind = count_from_front(view.turned(), only).seen;
  return count;
}

CellPixels CellCounterGl::count_from_front(const ParallelView& view, std::optional<std::uint32_t> only) {
  make_room(view.pixels());
  set_view(view);
  const std::vector<CellPiece> all = pieces_in(view);
  std::vector<CellPiece> own;
  for (const CellPiece& piece : all)
    if (is_leaf(piece) && (!only || piece.cell == *only)) own.push_back(piece);
  CellPixels count;
  if (by_ == CountBy::queries) {
    count = count_by_queries(own, all, view);
  } else {
    count_by_ids(own, all, view);
    count = counted();
  }
  if (only && by_ == CountBy::ids)
    for (std::uint32_t c = 0; c < cells_; ++c)
      if (c != *only) count.seen[c] = 0;
  glDisable(GL_SCISSOR_TEST);
  return count;
}

}  // namespace manzana::foliage

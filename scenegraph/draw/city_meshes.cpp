#include "scenegraph/draw/city_meshes.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "gl/vertex_array.h"

namespace manzana::draw {
namespace {

constexpr std::uint32_t kMaxBlocks = 1U << 24;
constexpr std::uint32_t kFirstVertices = 1U << 14, kFirstIndices = 1U << 15;
constexpr std::uint64_t kLongUnseen = 600;  // frames: ten seconds
constexpr std::uint32_t kShares = 256;      // steps from one level to the next

/// By base instance: share / kShares of the finer of two levels; from kShares on, below 0, what the coarser has of it.
gl::Buffer make_shares() {
  std::vector<float> shares;
  for (const float side : {1.0F, -1.0F})
    for (std::uint32_t i = 0; i < kShares; ++i) shares.push_back(side * static_cast<float>(i) / kShares);
  return gl::make_buffer(std::as_bytes(std::span(shares)));
}
std::uint32_t instance_of(float share) {
  return std::clamp(static_cast<std::uint32_t>(share * kShares + 0.5F), 1U, kShares - 1);
}

gl::VertexArray make_array(const gl::Buffer& vertices, const gl::Buffer& indices, const gl::Buffer& textures) {
  gl::VertexArray array = gl::make_vertex_array(indices);
  const GLuint name = array.name();
  for (GLuint attribute = 0; attribute < 5; ++attribute) {
    glEnableVertexArrayAttrib(name, attribute);
    glVertexArrayAttribBinding(name, attribute, 0);
  }
  glVertexArrayAttribFormat(name, 0, 3, GL_FLOAT, GL_FALSE, offsetof(CityVertex, position));
  glVertexArrayAttribFormat(name, 1, 4, GL_INT_2_10_10_10_REV, GL_TRUE, offsetof(CityVertex, normal));
  glVertexArrayAttribIFormat(name, 2, 1, GL_UNSIGNED_INT, offsetof(CityVertex, colour));
  glVertexArrayAttribFormat(name, 3, 2, GL_FLOAT, GL_FALSE, offsetof(CityVertex, uv));
  glVertexArrayAttribIFormat(name, 4, 1, GL_UNSIGNED_INT, offsetof(CityVertex, block));
  glVertexArrayVertexBuffer(name, 0, vertices.name(), 0, sizeof(CityVertex));
  if (textures.name() == 0) return array;
  glEnableVertexArrayAttrib(name, 6);
  glVertexArrayAttribBinding(name, 6, 2);
  glVertexArrayAttribIFormat(name, 6, 1, GL_UNSIGNED_INT, 0);
  glVertexArrayVertexBuffer(name, 2, textures.name(), 0, sizeof(std::uint32_t));
  return array;
}

gl::VertexArray with_shares(gl::VertexArray array, const gl::Buffer& shares) {
  glEnableVertexArrayAttrib(array.name(), 5);
  glVertexArrayAttribBinding(array.name(), 5, 1);
  glVertexArrayAttribFormat(array.name(), 5, 1, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayBindingDivisor(array.name(), 1, 1);
  glVertexArrayVertexBuffer(array.name(), 1, shares.name(), 0, sizeof(float));
  return array;
}

/// A buffer of so many bytes that begins with what the other has.
gl::Buffer enlarged(const gl::Buffer& from, std::size_t from_bytes, std::size_t bytes) {
  gl::Buffer to = gl::make_writable_buffer(bytes);
  if (from_bytes > 0) glCopyNamedBufferSubData(from.name(), to.name(), 0, 0, static_cast<GLsizeiptr>(from_bytes));
  return to;
}

template <class T>
void put(const gl::Buffer& buffer, std::size_t at, const std::vector<T>& items) {
  glNamedBufferSubData(buffer.name(), static_cast<GLintptr>(at * sizeof(T)),
                       static_cast<GLsizeiptr>(items.size() * sizeof(T)), items.data());
}

std::size_t bytes_of(const LayerPieces& layer) {
  const auto bytes = [](std::size_t sum, const Piece& piece) { return sum + piece.bytes(); };
  return std::accumulate(layer.pieces.begin(), layer.pieces.begin() + layer.count, std::size_t{0}, bytes);
}

void settle(LayerPieces& pieces) {
  pieces.fading = 0;
  for (const std::uint32_t piece : pieces.in_sight) pieces.settle(piece);
}

}  // namespace

CityMeshes::CityMeshes(const Scene& scene)
    : buildings(scene.buildings, scene.tree.origin),
      surfaces(scene.surfaces, scene.tree.origin),
      textured_(!scene.pictures.textures.empty()),
      shares_(make_shares()),
      all_(bytes_of(buildings) + bytes_of(surfaces)) {
  if (scene.blocks.size() >= kMaxBlocks) throw std::runtime_error("a scene of 2^24 blocks cannot be drawn");
  wanted_.reserve(buildings.pieces.size() + surfaces.pieces.size());
  resize(kFirstVertices, kFirstIndices);
}

std::size_t CityMeshes::bytes_for(std::size_t vertices, std::size_t indices) const {
  return vertices * (sizeof(CityVertex) + (textured_ ? sizeof(std::uint32_t) : 0)) + indices * sizeof(std::uint32_t);
}

std::size_t CityMeshes::device_bytes() const { return bytes_for(vertex_room_.size(), index_room_.size()); }

std::size_t CityMeshes::bring(const Scene& scene, std::span<const culling::ObjectRun> objects, const MeshDetail& detail,
                              std::size_t most_bytes) {
  ++frame_;
  wanted_.clear();
  want(scene.buildings, buildings, objects, detail);
  want(scene.surfaces, surfaces, objects, detail);
  std::size_t brought = 0, left = 0;
  missing_ = 0;
  for (const Wanted& wanted : wanted_) {
    const std::size_t bytes = wanted.pieces->pieces[wanted.item].bytes();
    if (brought + bytes > most_bytes && (brought > 0 || most_bytes == 0))
      left += bytes;
    else if (hold(wanted))
      brought += bytes;
    else
      missing_ += bytes;
  }
  settle(buildings);
  settle(surfaces);
  return left;
}

void CityMeshes::want(const MeshLayer& layer, LayerPieces& pieces, std::span<const culling::ObjectRun> objects,
                      const MeshDetail& detail) {
  pieces.in_sight.clear();
  for (const culling::ObjectRun& run : objects)
    pieces.for_each(layer.table, run, [&](std::uint32_t piece, const culling::ObjectRun&) {
      if (std::exchange(pieces.chosen[piece], frame_) == frame_) return;
      pieces.choose(piece, detail);
      pieces.in_sight.push_back(piece);
      for (const std::uint32_t item : {pieces.shown[piece].item, pieces.shown[piece].next}) {
        const std::uint64_t before = std::exchange(pieces.seen[item], frame_);
        if (before == frame_) continue;
        if (before == 0) seen_ += pieces.pieces[item].bytes();
        if (!pieces.held[item] && pieces.pieces[item].indices > 0) wanted_.push_back({&layer, &pieces, item});
      }
    });
}

bool CityMeshes::hold(const Wanted& wanted) {
  const Piece& piece = wanted.pieces->pieces[wanted.item];
  for (;;) {
    if (const auto place = take(piece)) {
      upload(wanted, *place);
      held_ += piece.bytes();
      return true;
    }
    if (!make_room(piece)) return false;
  }
}

std::optional<CityMeshes::Place> CityMeshes::take(const Piece& piece) {
  const auto vertices = vertex_room_.take(size_of(piece.vertices));
  if (!vertices) return {};
  const auto indices = index_room_.take(piece.indices);
  if (indices) return Place{*vertices, *indices};
  vertex_room_.give(*vertices, size_of(piece.vertices));
  return {};
}

/// What has long been out of sight goes before the buffers grow, the rest when they may not.
bool CityMeshes::make_room(const Piece& piece) {
  return (frame_ > kLongUnseen && release_before(frame_ - kLongUnseen)) || grow(piece) || release_before(frame_);
}

bool CityMeshes::grow(const Piece& piece) {
  const auto more = [](const gl::Ranges& room, std::uint32_t n) {
    return room.size() - room.taken() >= 2 * n ? room.size() : std::max(room.size() + n, room.size() / 8 * 9);
  };
  std::uint32_t vertices = more(vertex_room_, size_of(piece.vertices)), indices = more(index_room_, piece.indices);
  if (vertices == vertex_room_.size() && indices == index_room_.size())  // there is enough, but in places too small
    vertices += size_of(piece.vertices), indices += piece.indices;
  if (most_bytes_ > 0 && bytes_for(vertices, indices) > most_bytes_) return false;
  resize(vertices, indices);
  return true;
}

/// The piece that was not seen for longest goes, if that was before.
bool CityMeshes::release_before(std::uint64_t frame) {
  LayerPieces* oldest = nullptr;
  std::size_t piece = 0;
  for (LayerPieces* layer : {&buildings, &surfaces})
    for (std::size_t p = 0; p < layer->pieces.size(); ++p)
      if (layer->held[p] && layer->seen[p] < frame) oldest = layer, piece = p, frame = layer->seen[p];
  if (oldest != nullptr) release(*oldest, piece);
  return oldest != nullptr;
}

void CityMeshes::release(LayerPieces& layer, std::size_t p) {
  const Piece& piece = layer.pieces[p];
  vertex_room_.give(layer.held[p]->vertices_at, size_of(piece.vertices));
  index_room_.give(layer.held[p]->first[0].front(), piece.indices);
  layer.held[p].reset();
  held_ -= piece.bytes();
}

void CityMeshes::upload(const Wanted& wanted, const Place& place) {
  LayerPieces& layer = *wanted.pieces;
  const ItemMesh item = mesh_of(*wanted.layer, layer, wanted.item);
  const std::uint32_t first_row = layer.pieces[wanted.item % layer.count].rows.first;
  PaintedIndices sorted = sort_by_paint(item.mesh, item.index_first);
  put_vertices(place.vertices, item.mesh);
  put(indices_, place.indices, sorted.indices);
  for (std::size_t p = 0; p < kPaints; ++p) {
    layer.painted[p] |= sorted.first[p].front() < sorted.first[p].back();
    for (std::uint32_t& first : sorted.first[p]) first += place.indices;
  }
  layer.held[wanted.item] = LayerPieces::Held{place.vertices, std::move(sorted.first), worn_by(item, first_row)};
}

void CityMeshes::put_vertices(std::uint32_t at, const CityMesh& mesh) {
  put(vertices_, at, mesh.vertices);
  if (!textured_) return;
  std::vector<std::uint32_t> textures = mesh.textures;
  textures.resize(mesh.vertices.size());
  put(textures_, at, textures);
}

void CityMeshes::paint(const MeshLayer& layer, LayerPieces& pieces, std::span<const std::uint32_t> colours) {
  pieces.colours.resize(colours.size(), kOwnColour);
  for (std::uint32_t p = 0; p < pieces.count; ++p) {
    const auto of_piece = [&](auto& all) {
      return std::span(all).subspan(pieces.pieces[p].rows.first, size_of(pieces.pieces[p].rows));
    };
    if (std::ranges::equal(of_piece(pieces.colours), of_piece(colours))) continue;
    std::ranges::copy(of_piece(colours), of_piece(pieces.colours).begin());
    for (std::uint32_t item = p; item < pieces.pieces.size(); item += pieces.count)
      if (pieces.held[item]) put_vertices(pieces.held[item]->vertices_at, mesh_of(layer, pieces, item).mesh);
  }
}

void CityMeshes::resize(std::uint32_t vertices, std::uint32_t indices) {
  vertices_ = enlarged(vertices_, vertex_room_.size() * sizeof(CityVertex), vertices * sizeof(CityVertex));
  indices_ = enlarged(indices_, index_room_.size() * sizeof(std::uint32_t), indices * sizeof(std::uint32_t));
  if (textured_)
    textures_ = enlarged(textures_, vertex_room_.size() * sizeof(std::uint32_t), vertices * sizeof(std::uint32_t));
  vertex_room_.grow(vertices);
  index_room_.grow(indices);
  array_ = make_array(vertices_, indices_, textures_);
  fading_array_ = with_shares(make_array(vertices_, indices_, textures_), shares_);
}

Drawn make_commands(const LayerTable& table, const LayerPieces& layer, Paint paint,
                    std::span<const culling::ObjectRun> runs, gl::DrawCommand* out, bool whole) {
  const auto p = static_cast<std::size_t>(paint);
  Drawn drawn;
  gl::DrawCommand open{0, 1, 0, 0, 0};
  const auto close = [&] {  // `out` is the GPU's memory: written in order, never read
    if (open.count == 0) return;
    out[drawn.commands++] = open;
    drawn.triangles += open.count / 3;
  };
  const auto add = [&](std::uint32_t item, const culling::ObjectRun& rows, std::uint32_t instance) {
    if (!layer.held[item]) return;
    const auto& first = layer.held[item]->first[p];
    const std::uint32_t before = layer.pieces[item].rows.first;
    const std::uint32_t begin = first[rows.first - before], end = first[rows.last - before];
    const auto base = static_cast<GLint>(layer.held[item]->vertices_at);
    if (begin == open.first_index + open.count && base == open.base_vertex && instance == open.base_instance) {
      open.count += end - begin;
    } else if (begin < end) {
      close();
      open = {end - begin, 1, begin, base, instance};
    }
  };
  const auto add_shown = [&](std::uint32_t piece, const culling::ObjectRun& rows) {
    const auto& [item, next, share] = layer.shown[piece];
    if ((share >= 1) != whole) return;
    if (whole) return add(item, rows, 0);
    add(item, rows, instance_of(share));
    add(next, rows, kShares + instance_of(share));
  };
  for (const culling::ObjectRun& run : runs) layer.for_each(table, run, add_shown);
  close();
  return drawn;
}

std::size_t stream_bytes(const LayerPieces& layer, std::size_t runs) {
  const auto padded = [&](bool whole) {
    return kPaints * gl::StreamBuffer::padded(most_commands(layer, runs, whole) * sizeof(gl::DrawCommand));
  };
  return padded(true) + (layer.has_levels() ? padded(false) : 0);
}

Drawn draw_city(const CityMeshes& meshes, const LayerTable& table, const LayerPieces& layer,
                const PaintPrograms& paints, const PaintPrograms& fading, std::span<const culling::ObjectRun> objects,
                gl::StreamBuffer& stream) {
  Drawn drawn;
  const auto draw = [&](std::size_t p, bool whole) {
    const auto commands = stream.take<gl::DrawCommand>(most_commands(layer, objects.size(), whole));
    const Drawn part = make_commands(table, layer, static_cast<Paint>(p), objects, commands.items, whole);
    drawn.triangles += part.triangles;
    drawn.commands += part.commands;
    if (part.commands == 0) return;
    glUseProgram((whole ? paints : fading)[p].name());
    glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, reinterpret_cast<const void*>(commands.offset),
                                static_cast<GLsizei>(part.commands), 0);
  };
  for (const bool whole : {true, false}) {
    if (!whole && layer.fading == 0) continue;
    glBindVertexArray((whole ? meshes.array() : meshes.fading_array()).name());
    for (std::size_t p = 0; p < kPaints; ++p)
      if (layer.painted[p]) draw(p, whole);
  }
  return drawn;
}

}  // namespace manzana::draw

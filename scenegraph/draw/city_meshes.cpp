#include "scenegraph/draw/city_meshes.h"

#include <algorithm>
#include <stdexcept>

#include "gl/vertex_array.h"

namespace manzana::draw {
namespace {

constexpr std::uint32_t kMaxBlocks = 1U << 24;
constexpr std::uint32_t kPieceVertices = 2048;
constexpr std::uint32_t kFirstVertices = 1U << 14, kFirstIndices = 1U << 15;
constexpr std::uint64_t kLongUnseen = 600;  // frames: ten seconds

/// From the lowest to past the highest vertex of the indices.
culling::ObjectRun vertices_of(std::span<const std::uint32_t> indices) {
  if (indices.empty()) return {0, 0};
  const auto [low, high] = std::ranges::minmax_element(indices);
  return {*low, *high + 1};
}

std::span<const std::uint32_t> indices_of(const MeshLayer& layer, const culling::ObjectRun& rows) {
  return layer.mesh.indices.items().subspan(layer.index_first[rows.first],
                                            layer.index_first[rows.last] - layer.index_first[rows.first]);
}

/// Of a baked city, what was copied from the file.
void let_go(const MeshLayer& layer, const Piece& piece) {
  layer.mesh.vertices.let_go(piece.vertices.first, piece.vertices.last);
  layer.mesh.indices.let_go(layer.index_first[piece.rows.first], layer.index_first[piece.rows.last]);
}

/// The piece's part of the mesh, its vertices counted from its first; a vertex's block has the street's lanes above it.
/// `colours`: a row each, or none.
CityMesh mesh_of(const MeshLayer& layer, const Piece& piece, std::span<const std::uint32_t> colours) {
  CityMesh mesh;
  mesh.vertices.assign(layer.mesh.vertices.begin() + piece.vertices.first,
                       layer.mesh.vertices.begin() + piece.vertices.last);
  for (const std::uint32_t i : indices_of(layer, piece.rows)) mesh.indices.push_back(i - piece.vertices.first);
  const std::vector<std::uint8_t> lanes = count_lanes(mesh);
  for (std::size_t i = 0; i < lanes.size(); ++i) mesh.vertices[i].block |= std::uint32_t{lanes[i]} << 24;
  for (std::uint32_t row = piece.rows.first; !colours.empty() && row < piece.rows.last; ++row) {
    if (colours[row] == kOwnColour) continue;
    for (const std::uint32_t i : indices_of(layer, {row, row + 1})) {
      CityVertex& vertex = mesh.vertices[i - piece.vertices.first];
      vertex.colour = pack_colour(colours[row], static_cast<Material>(vertex.colour >> 24));
    }
  }
  let_go(layer, piece);
  return mesh;
}

std::vector<std::uint32_t> index_first_of(const MeshLayer& layer, const Piece& piece) {
  std::vector<std::uint32_t> first;
  for (std::uint32_t row = piece.rows.first; row <= piece.rows.last; ++row)
    first.push_back(layer.index_first[row] - layer.index_first[piece.rows.first]);
  return first;
}

gl::VertexArray make_array(const gl::Buffer& vertices, const gl::Buffer& indices) {
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
  return array;
}

std::size_t bytes_for(std::size_t vertices, std::size_t indices) {
  return vertices * sizeof(CityVertex) + indices * sizeof(std::uint32_t);
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

template <class Keep>
std::size_t sum_of(std::initializer_list<const LayerPieces*> layers, Keep&& keep) {
  std::size_t sum = 0;
  for (const LayerPieces* layer : layers)
    for (std::size_t p = 0; p < layer->pieces.size(); ++p)
      if (keep(*layer, p)) sum += layer->pieces[p].bytes();
  return sum;
}

}  // namespace

std::vector<Piece> cut_into_pieces(const MeshLayer& layer) {
  std::vector<Piece> pieces;
  const auto rows = static_cast<std::uint32_t>(layer.index_first.empty() ? 0 : layer.index_first.size() - 1);
  for (std::uint32_t row = 0; row < rows; ++row) {
    if (pieces.empty() || size_of(pieces.back().vertices) >= kPieceVertices) pieces.push_back({{row, row}, {0, 0}});
    Piece& piece = pieces.back();
    const auto more = indices_of(layer, {row, row + 1});
    const culling::ObjectRun reached = vertices_of(more);
    piece.rows.last = row + 1;
    if (more.empty()) continue;
    piece.vertices = piece.indices == 0 ? reached
                                        : culling::ObjectRun{std::min(piece.vertices.first, reached.first),
                                                             std::max(piece.vertices.last, reached.last)};
    piece.indices += static_cast<std::uint32_t>(more.size());
  }
  layer.mesh.indices.let_go(0, layer.mesh.indices.size());
  return pieces;
}

LayerPieces::LayerPieces(const MeshLayer& layer)
    : pieces(cut_into_pieces(layer)), held(pieces.size()), seen(pieces.size()) {
  for (std::uint32_t p = 0; p < pieces.size(); ++p) piece_of.insert(piece_of.end(), size_of(pieces[p].rows), p);
}

CityMeshes::CityMeshes(const Scene& scene) : buildings(scene.buildings), surfaces(scene.surfaces) {
  if (scene.blocks.size() >= kMaxBlocks) throw std::runtime_error("a scene of 2^24 blocks cannot be drawn");
  wanted_.reserve(buildings.pieces.size() + surfaces.pieces.size());
  resize(kFirstVertices, kFirstIndices);
}

std::size_t CityMeshes::device_bytes() const { return bytes_for(vertex_room_.size(), index_room_.size()); }

std::size_t CityMeshes::seen_bytes() const {
  return sum_of({&buildings, &surfaces}, [](const LayerPieces& layer, std::size_t p) { return layer.seen[p] > 0; });
}

std::size_t CityMeshes::all_bytes() const {
  return sum_of({&buildings, &surfaces}, [](const LayerPieces&, std::size_t) { return true; });
}

std::size_t CityMeshes::bring(const Scene& scene, std::span<const culling::ObjectRun> objects, std::size_t most_bytes) {
  ++frame_;
  wanted_.clear();
  want(scene.buildings, buildings, objects);
  want(scene.surfaces, surfaces, objects);
  std::size_t brought = 0, left = 0;
  missing_ = 0;
  for (const Wanted& wanted : wanted_) {
    const std::size_t bytes = wanted.pieces->pieces[wanted.piece].bytes();
    if (brought + bytes > most_bytes && (brought > 0 || most_bytes == 0))
      left += bytes;
    else if (hold(wanted))
      brought += bytes;
    else
      missing_ += bytes;
  }
  return left;
}

void CityMeshes::want(const MeshLayer& layer, LayerPieces& pieces, std::span<const culling::ObjectRun> objects) {
  for (const culling::ObjectRun& run : objects)
    pieces.for_each(layer.table, run, [&](std::uint32_t piece, const culling::ObjectRun&) {
      if (pieces.seen[piece] == frame_) return;
      pieces.seen[piece] = frame_;
      if (!pieces.held[piece] && pieces.pieces[piece].indices > 0) wanted_.push_back({&layer, &pieces, piece});
    });
}

bool CityMeshes::hold(const Wanted& wanted) {
  const Piece& piece = wanted.pieces->pieces[wanted.piece];
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
  const Piece& piece = layer.pieces[wanted.piece];
  const CityMesh mesh = mesh_of(*wanted.layer, piece, layer.colours);
  PaintedIndices sorted = sort_by_paint(mesh, index_first_of(*wanted.layer, piece));
  put(vertices_, place.vertices, mesh.vertices);
  put(indices_, place.indices, sorted.indices);
  for (std::size_t p = 0; p < kPaints; ++p) {
    layer.painted[p] |= sorted.first[p].front() < sorted.first[p].back();
    for (std::uint32_t& first : sorted.first[p]) first += place.indices;
  }
  layer.held[wanted.piece] = LayerPieces::Held{place.vertices, std::move(sorted.first)};
}

void CityMeshes::paint(const MeshLayer& layer, LayerPieces& pieces, std::span<const std::uint32_t> colours) {
  pieces.colours.resize(colours.size(), kOwnColour);
  for (std::size_t p = 0; p < pieces.pieces.size(); ++p) {
    const auto of_piece = [&](auto& all) {
      return std::span(all).subspan(pieces.pieces[p].rows.first, size_of(pieces.pieces[p].rows));
    };
    if (std::ranges::equal(of_piece(pieces.colours), of_piece(colours))) continue;
    std::ranges::copy(of_piece(colours), of_piece(pieces.colours).begin());
    if (pieces.held[p])
      put(vertices_, pieces.held[p]->vertices_at, mesh_of(layer, pieces.pieces[p], pieces.colours).vertices);
  }
}

void CityMeshes::resize(std::uint32_t vertices, std::uint32_t indices) {
  vertices_ = enlarged(vertices_, vertex_room_.size() * sizeof(CityVertex), vertices * sizeof(CityVertex));
  indices_ = enlarged(indices_, index_room_.size() * sizeof(std::uint32_t), indices * sizeof(std::uint32_t));
  vertex_room_.grow(vertices);
  index_room_.grow(indices);
  array_ = make_array(vertices_, indices_);
}

Drawn make_commands(const LayerTable& table, const LayerPieces& layer, Paint paint,
                    std::span<const culling::ObjectRun> runs, gl::DrawCommand* out) {
  const auto p = static_cast<std::size_t>(paint);
  Drawn drawn;
  gl::DrawCommand open{0, 1, 0, 0, 0};
  const auto close = [&] {  // `out` is the GPU's memory: written in order, never read
    if (open.count == 0) return;
    out[drawn.commands++] = open;
    drawn.triangles += open.count / 3;
  };
  const auto add = [&](std::uint32_t piece, const culling::ObjectRun& rows) {
    if (!layer.held[piece]) return;
    const auto& first = layer.held[piece]->first[p];
    const std::uint32_t before = layer.pieces[piece].rows.first;
    const std::uint32_t begin = first[rows.first - before], end = first[rows.last - before];
    const auto base = static_cast<GLint>(layer.held[piece]->vertices_at);
    if (begin == open.first_index + open.count && base == open.base_vertex) {
      open.count += end - begin;
    } else if (begin < end) {
      close();
      open = {end - begin, 1, begin, base, 0};
    }
  };
  for (const culling::ObjectRun& run : runs) layer.for_each(table, run, add);
  close();
  return drawn;
}

std::size_t stream_bytes(const LayerPieces& layer, std::size_t runs) {
  return kPaints * gl::StreamBuffer::padded(most_commands(layer, runs) * sizeof(gl::DrawCommand));
}

Drawn draw_city(const CityMeshes& meshes, const LayerTable& table, const LayerPieces& layer,
                const PaintPrograms& paints, std::span<const culling::ObjectRun> objects, gl::StreamBuffer& stream) {
  Drawn drawn;
  glBindVertexArray(meshes.array().name());
  for (std::size_t p = 0; p < kPaints; ++p) {
    if (!layer.painted[p]) continue;
    const auto commands = stream.take<gl::DrawCommand>(most_commands(layer, objects.size()));
    const Drawn part = make_commands(table, layer, static_cast<Paint>(p), objects, commands.items);
    drawn.triangles += part.triangles;
    drawn.commands += part.commands;
    if (part.commands == 0) continue;
    glUseProgram(paints[p].name());
    glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, reinterpret_cast<const void*>(commands.offset),
                                static_cast<GLsizei>(part.commands), 0);
  }
  return drawn;
}

}  // namespace manzana::draw

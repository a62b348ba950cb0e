#include "scenegraph/draw/city_pieces.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace manzana::draw {
namespace {

constexpr std::uint32_t kPieceVertices = 2048;
constexpr double kGain = 0.7;  // of the indices that are drawn without it, at most, has a level

/// From the lowest to past the highest vertex of the indices.
culling::ObjectRun vertices_of(std::span<const std::uint32_t> indices) {
  if (indices.empty()) return {0, 0};
  const auto [low, high] = std::ranges::minmax_element(indices);
  return {*low, *high + 1};
}

std::span<const std::uint32_t> indices_of(const MeshRows& layer, const culling::ObjectRun& rows) {
  return layer.mesh.indices.items().subspan(layer.index_first[rows.first],
                                            layer.index_first[rows.last] - layer.index_first[rows.first]);
}

/// Of a baked city, what was copied from the file.
void let_go(const MeshRows& layer, const culling::ObjectRun& rows, const culling::ObjectRun& vertices) {
  layer.mesh.vertices.let_go(vertices.first, vertices.last);
  if (!layer.mesh.textures.empty()) layer.mesh.textures.let_go(vertices.first, vertices.last);
  layer.mesh.indices.let_go(layer.index_first[rows.first], layer.index_first[rows.last]);
}

/// Which mesh a row has at a level.
const MeshRows& rows_at(const MeshLayer& layer, std::size_t level, std::uint32_t row) {
  for (; level > 0; --level)
    if (layer.levels[level - 1].index_first[row] < layer.levels[level - 1].index_first[row + 1])
      return layer.levels[level - 1];
  return layer;
}

Piece at_level(const MeshLayer& layer, std::size_t level, const culling::ObjectRun& rows) {
  Piece piece{rows, {0, 0}};
  for (std::uint32_t row = rows.first; row < rows.last; ++row) {
    const auto indices = indices_of(rows_at(layer, level, row), {row, row + 1});
    piece.vertices.last += size_of(vertices_of(indices));
    piece.indices += static_cast<std::uint32_t>(indices.size());
  }
  return piece;
}

/// Behind the pieces, if anything has levels.
void add_levels(std::vector<Piece>& pieces, const MeshLayer& layer) {
  const bool any = std::ranges::any_of(layer.levels, [](const MeshRows& level) { return !level.mesh.indices.empty(); });
  std::vector<std::uint32_t> drawn;  // indices of each piece without the level
  for (const Piece& piece : pieces) drawn.push_back(piece.indices);
  for (std::size_t level = 1; any && level <= kMeshLevels; ++level)
    for (std::size_t p = 0; p < drawn.size(); ++p) {
      const Piece piece = at_level(layer, level, pieces[p].rows);
      const bool gains = static_cast<double>(piece.indices) <= kGain * drawn[p];
      pieces.push_back(gains ? piece : Piece{piece.rows, {0, 0}});
      if (gains) drawn[p] = piece.indices;
    }
  for (const MeshRows& level : layer.levels) level.mesh.indices.let_go(0, level.mesh.indices.size());
}

void append(CityMesh& mesh, const StoredMesh& from, const culling::ObjectRun& vertices) {
  mesh.vertices.insert(mesh.vertices.end(), from.vertices.begin() + vertices.first,
                       from.vertices.begin() + vertices.last);
  const std::size_t all = from.textures.size(), last = std::min<std::size_t>(vertices.last, all);
  if (vertices.first >= last) return;
  mesh.textures.resize(mesh.vertices.size() - size_of(vertices));
  mesh.textures.insert(mesh.textures.end(), from.textures.begin() + vertices.first,
                       from.textures.begin() + static_cast<std::ptrdiff_t>(last));
}

void append(ItemMesh& item, const MeshRows& rows, std::uint32_t row) {
  const auto indices = indices_of(rows, {row, row + 1});
  const culling::ObjectRun vertices = vertices_of(indices);
  const auto base = static_cast<std::uint32_t>(item.mesh.vertices.size());
  append(item.mesh, rows.mesh, vertices);
  for (const std::uint32_t i : indices) item.mesh.indices.push_back(i - vertices.first + base);
  item.index_first.push_back(static_cast<std::uint32_t>(item.mesh.indices.size()));
  let_go(rows, {row, row + 1}, vertices);
}

/// As they lie in the layer: with one copy.
ItemMesh whole_mesh_of(const MeshLayer& layer, const Piece& piece) {
  ItemMesh item;
  append(item.mesh, layer.mesh, piece.vertices);
  for (const std::uint32_t i : indices_of(layer, piece.rows)) item.mesh.indices.push_back(i - piece.vertices.first);
  for (std::uint32_t row = piece.rows.first; row <= piece.rows.last; ++row)
    item.index_first.push_back(layer.index_first[row] - layer.index_first[piece.rows.first]);
  let_go(layer, piece.rows, piece.vertices);
  return item;
}

ItemMesh level_mesh_of(const MeshLayer& layer, std::size_t level, const culling::ObjectRun& rows) {
  ItemMesh item;
  item.index_first.push_back(0);
  for (std::uint32_t row = rows.first; row < rows.last; ++row) append(item, rows_at(layer, level, row), row);
  return item;
}

/// `colours`: a row of the item each.
void recolour(ItemMesh& item, std::span<const std::uint32_t> colours) {
  for (std::size_t row = 0; row < colours.size(); ++row)
    for (std::uint32_t i = item.index_first[row]; colours[row] != kOwnColour && i < item.index_first[row + 1]; ++i) {
      CityVertex& vertex = item.mesh.vertices[item.mesh.indices[i]];
      if (texture_of(item.mesh, item.mesh.indices[i]) > 0) item.mesh.textures[item.mesh.indices[i]] = kCovered;
      vertex.colour = pack_colour(colours[row], static_cast<Material>(vertex.colour >> 24));
    }
}

constexpr float kWidest = 1e6F;  // metres of a picture's side: where it is laid on as a line

/// The longer side of the whole picture, as a triangle has it.
float metres_of(const CityVertex& a, const CityVertex& b, const CityVertex& c) {
  const Vec3 p = b.position - a.position, q = c.position - a.position;
  const Vec2 s = b.uv - a.uv, t = c.uv - a.uv;
  const float turn = s.x * t.y - s.y * t.x;
  const float longer = std::max(glm::length(p * t.y - q * s.y), glm::length(q * s.x - p * t.x));
  return longer < kWidest * std::abs(turn) ? longer / std::abs(turn) : kWidest;
}

}  // namespace

double distance(const MeshDetail& detail, const culling::BoxD& box) {
  return glm::length(glm::max(glm::max(box.min - detail.eye, detail.eye - box.max), Vec3d(0)));
}

std::vector<Worn> worn_by(const ItemMesh& item, std::uint32_t first_row) {
  std::vector<Worn> worn;
  const CityMesh& mesh = item.mesh;
  for (std::uint32_t row = 0; row + 1 < item.index_first.size() && !mesh.textures.empty(); ++row) {
    std::map<std::uint32_t, float> metres;
    for (std::uint32_t i = item.index_first[row]; i < item.index_first[row + 1]; i += 3) {
      const std::uint32_t texture = texture_of(mesh, mesh.indices[i + 2]);
      if (texture == 0 || texture == kCovered) continue;
      const auto corner = [&](std::uint32_t k) -> const CityVertex& { return mesh.vertices[mesh.indices[i + k]]; };
      float& most = metres[texture];
      most = std::max(most, metres_of(corner(0), corner(1), corner(2)));
    }
    for (const auto& [texture, side] : metres) worn.push_back({first_row + row, texture, side});
  }
  return worn;
}

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

LayerPieces::LayerPieces(const MeshLayer& layer, const Vec3d& origin)
    : pieces(cut_into_pieces(layer)), boxes(pieces.size()), chosen(pieces.size()), shown(pieces.size()) {
  count = static_cast<std::uint32_t>(pieces.size());
  for (std::uint32_t p = 0; p < count; ++p) {
    piece_of.insert(piece_of.end(), size_of(pieces[p].rows), p);
    shown[p] = {p, p, 1};
    for (std::uint32_t row = pieces[p].rows.first; row < pieces[p].rows.last; ++row)
      boxes[p] = merge(boxes[p], box_of(layer.table, row, origin));
  }
  in_sight.reserve(count);
  add_levels(pieces, layer);
  held.resize(pieces.size());
  seen.resize(pieces.size());
}

void LayerPieces::choose(std::uint32_t piece, const MeshDetail& detail) {
  Shown choice{piece, piece, 1};
  const double away = has_levels() ? distance(detail, boxes[piece]) : 0;
  for (std::uint32_t item = piece + count, level = 0; item < pieces.size(); item += count, ++level) {
    if (pieces[item].indices == 0) continue;
    const double from = kMeshLevelErrors[level] / detail.error_at_1m, alone = from * kLevelFade;
    if (!(away > from)) break;
    choice.next = item;
    if (away < alone) {
      choice.share = static_cast<float>((alone - away) / (alone - from));
      break;
    }
    choice.item = item;
  }
  shown[piece] = choice;
}

void LayerPieces::settle(std::uint32_t piece) {
  Shown& choice = shown[piece];
  if (!held[choice.item]) choice.item = choice.next;
  for (std::uint32_t item = piece; item < pieces.size() && !held[choice.item]; item += count) choice.item = item;
  if (choice.share >= 1 || choice.item == choice.next || !held[choice.next]) choice = {choice.item, choice.item, 1};
  fading += choice.share < 1 ? 1 : 0;
}

ItemMesh mesh_of(const MeshLayer& layer, const LayerPieces& pieces, std::uint32_t item) {
  const Piece& piece = pieces.pieces[item];
  const std::size_t level = item / pieces.count;
  ItemMesh out = level == 0 ? whole_mesh_of(layer, piece) : level_mesh_of(layer, level, piece.rows);
  const std::vector<std::uint8_t> lanes = count_lanes(out.mesh);
  for (std::size_t i = 0; i < lanes.size(); ++i) out.mesh.vertices[i].block |= std::uint32_t{lanes[i]} << 24;
  if (!pieces.colours.empty()) recolour(out, std::span(pieces.colours).subspan(piece.rows.first, size_of(piece.rows)));
  return out;
}

}  // namespace manzana::draw

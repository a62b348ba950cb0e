#pragma once
/// A layer's meshes cut into pieces of some thousand vertices, which come to the device and go. A piece of buildings
/// may be drawn at a level (MeshLayer::levels) where the metres by which that is off are no more than may be wrong so
/// far away; on the way to it each sample of a pixel shows one of both.
///   LayerPieces layer(scene.buildings, scene.tree.origin);
///   layer.choose(piece, {eye, error_at_1m});             // layer.shown[piece]
#include <array>
#include <optional>
#include <span>

#include "scenegraph/draw/city_layer.h"

namespace manzana::draw {

inline std::uint32_t size_of(const culling::ObjectRun& run) { return run.last - run.first; }

/// A run of a layer's rows, and their vertices; at a level only how many there are.
struct Piece {
  culling::ObjectRun rows, vertices;
  std::uint32_t indices = 0;
  std::size_t bytes() const { return size_of(vertices) * sizeof(CityVertex) + indices * sizeof(std::uint32_t); }
};
/// Of at least 2048 vertices each, as long as there are so many.
std::vector<Piece> cut_into_pieces(const MeshLayer& layer);

/// What may be wrong, and how small pixels are.
struct MeshDetail {
  Vec3d eye{0};            ///< in L
  double error_at_1m = 0;  ///< metres, for each metre that a thing is away; 0: nothing
  double pixel_at_1m = 0;  ///< likewise
};
double distance(const MeshDetail& detail, const culling::BoxD& box);  ///< metres; 0 inside

/// What a row's mesh wears, and how many metres the side of the picture is there, at most.
struct Worn {
  std::uint32_t row = 0;      ///< of the layer
  std::uint32_t texture = 0;  ///< from 1
  float metres = 0;
};
/// In CityMesh::textures of an item: what wore a picture has a host's colour.
inline constexpr std::uint32_t kCovered = ~0U;
/// A level is alone from so many times the distance on where it first may be drawn.
inline constexpr double kLevelFade = 1.25;

struct LayerPieces {
  /// `origin`: of the boxes in the layer's table.
  LayerPieces(const MeshLayer& layer, const Vec3d& origin);

  /// On the GPU. Of paint p, row i of the piece has the indices [first[p][i], first[p][i + 1]) of the buffer.
  struct Held {
    std::uint32_t vertices_at = 0;
    std::array<std::vector<std::uint32_t>, kPaints> first;
    std::vector<Worn> worn = {};
  };
  /// Two items of a piece, or one.
  struct Shown {
    std::uint32_t item = 0, next = 0;
    float share = 1;  ///< of the samples that the first covers, above 0; the others show the next
  };
  std::uint32_t count = 0;    ///< of the pieces
  std::vector<Piece> pieces;  ///< items: the pieces, then each as it is at level 1 (levels[0]), and so on. Without
                              ///< indices where a level is no better than the one before
  std::vector<std::uint32_t> piece_of;    ///< a row each
  std::vector<std::optional<Held>> held;  ///< an item each
  std::vector<std::uint32_t> colours;     ///< a row each, once some have colours that are not their own
  std::vector<std::uint64_t> seen;        ///< an item each: when it was last in sight; 0: never
  std::array<bool, kPaints> painted{};    ///< whether any item that has been held has the paint
  std::vector<culling::BoxD> boxes;       ///< a piece each, in L
  std::vector<std::uint64_t> chosen;      ///< a piece each: when
  std::vector<Shown> shown;               ///< a piece each
  std::vector<std::uint32_t> in_sight;    ///< pieces that were chosen last
  std::size_t fading = 0;                 ///< of these, those of which two items are shown

  bool has_levels() const { return pieces.size() > count; }
  void choose(std::uint32_t piece, const MeshDetail& detail);
  /// Shows what is held in place of what is not.
  void settle(std::uint32_t piece);

  /// part(piece, rows) for what of each piece the objects of the tree's are.
  template <class Part>
  void for_each(const LayerTable& table, const culling::ObjectRun& objects, Part&& part) const {
    const culling::ObjectRun rows = table.rows(objects);
    for (std::uint32_t row = rows.first; row < rows.last;) {
      const std::uint32_t piece = piece_of[row], end = std::min(rows.last, pieces[piece].rows.last);
      part(piece, culling::ObjectRun{row, end});
      row = end;
    }
  }
};

/// An item as it is drawn: its vertices counted from its first, a vertex's block with the street's lanes above it, and
/// where each row's indices begin.
struct ItemMesh {
  CityMesh mesh;
  std::vector<std::uint32_t> index_first;
};
ItemMesh mesh_of(const MeshLayer& layer, const LayerPieces& pieces, std::uint32_t item);
/// Row after row, from that of the layer on which the item begins.
std::vector<Worn> worn_by(const ItemMesh& item, std::uint32_t first_row);

}  // namespace manzana::draw

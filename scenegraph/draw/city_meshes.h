#pragma once
/// The part of a city's meshes that is on the GPU. It comes in pieces of a layer, of some thousand vertices each, when
/// they are first in sight; they go when others need their place, those first that have not been seen for longest. So
/// what is held follows what was looked at, not how large the city is.
///   CityMeshes meshes(scene);
///   meshes.bring(scene, objects, bytes_of_this_frame);
///   std::size_t n = make_commands(scene.buildings.table, meshes.buildings, Paint::facade, objects, out).commands;
#include <algorithm>
#include <optional>

#include "gl/ranges.h"
#include "scenegraph/draw/city_layer.h"

namespace manzana::draw {

inline std::uint32_t size_of(const culling::ObjectRun& run) { return run.last - run.first; }

/// A run of a layer's rows, and their vertices.
struct Piece {
  culling::ObjectRun rows, vertices;
  std::uint32_t indices = 0;
  std::size_t bytes() const { return size_of(vertices) * sizeof(CityVertex) + indices * sizeof(std::uint32_t); }
};
/// Of at least 2048 vertices each, as long as there are so many.
std::vector<Piece> cut_into_pieces(const MeshLayer& layer);

struct LayerPieces {
  explicit LayerPieces(const MeshLayer& layer);

  /// On the GPU. Of paint p, row i of the piece has the indices [first[p][i], first[p][i + 1]) of the buffer.
  struct Held {
    std::uint32_t vertices_at = 0;
    std::array<std::vector<std::uint32_t>, kPaints> first;
  };
  std::vector<Piece> pieces;
  std::vector<std::uint32_t> piece_of;    ///< a row each
  std::vector<std::optional<Held>> held;  ///< a piece each
  std::vector<std::uint32_t> colours;     ///< a row each, once some have colours that are not their own
  std::vector<std::uint64_t> seen;        ///< a piece each: when it was last in sight; 0: never
  std::array<bool, kPaints> painted{};    ///< whether any piece that has been held has the paint

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

class CityMeshes {
 public:
  /// Throws std::runtime_error for 2^24 blocks or more.
  explicit CityMeshes(const Scene& scene);
  /// Buffers do not grow beyond so many bytes from now on; 0: no limit.
  void limit(std::size_t most_bytes) { most_bytes_ = most_bytes; }

  /// What is in sight of `objects` (runs of the tree's) and not held is brought: at most so many bytes, but a piece at
  /// least, unless none are allowed. Returns how many bytes are left to bring; what there is no room for is not among
  /// them.
  std::size_t bring(const Scene& scene, std::span<const culling::ObjectRun> objects, std::size_t most_bytes);

  /// 0xRRGGBB a row of the layer, kOwnColour: as it was. Materials stay. Only what is held and changes is uploaded.
  void paint(const MeshLayer& layer, LayerPieces& pieces, std::span<const std::uint32_t> colours);

  LayerPieces buildings, surfaces;
  const gl::VertexArray& array() const { return array_; }
  std::size_t device_bytes() const;                       ///< of the buffers
  std::size_t held_bytes() const { return held_; }        ///< of pieces
  std::size_t seen_bytes() const;                         ///< of pieces that have been in sight at any time
  std::size_t all_bytes() const;                          ///< of all pieces
  std::size_t missing_bytes() const { return missing_; }  ///< in sight at the last bring(), and without room

 private:
  struct Wanted {
    const MeshLayer* layer;
    LayerPieces* pieces;
    std::uint32_t piece;
  };
  struct Place {
    std::uint32_t vertices, indices;
  };
  void want(const MeshLayer& layer, LayerPieces& pieces, std::span<const culling::ObjectRun> objects);
  bool hold(const Wanted& wanted);
  std::optional<Place> take(const Piece& piece);
  bool make_room(const Piece& piece);
  bool grow(const Piece& piece);
  bool release_before(std::uint64_t frame);
  void release(LayerPieces& layer, std::size_t piece);
  void upload(const Wanted& wanted, const Place& place);
  void resize(std::uint32_t vertices, std::uint32_t indices);

  std::size_t most_bytes_ = 0;
  gl::VertexArray array_;
  gl::Buffer vertices_, indices_;
  gl::Ranges vertex_room_, index_room_;
  std::vector<Wanted> wanted_;
  std::uint64_t frame_ = 0;
  std::size_t held_ = 0, missing_ = 0;
};

/// Commands for what is held of the runs, adjacent ones merged. `out` has room for most_commands().
Drawn make_commands(const LayerTable& table, const LayerPieces& layer, Paint paint,
                    std::span<const culling::ObjectRun> runs, gl::DrawCommand* out);
/// `objects`: runs of the tree's.
Drawn draw_city(const CityMeshes& meshes, const LayerTable& table, const LayerPieces& layer,
                const PaintPrograms& paints, std::span<const culling::ObjectRun> objects, gl::StreamBuffer& stream);
std::size_t stream_bytes(const LayerPieces& layer, std::size_t runs);

inline std::size_t most_commands(const LayerPieces& layer, std::size_t runs) { return runs + layer.pieces.size(); }

}  // namespace manzana::draw

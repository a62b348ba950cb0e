#pragma once
/// The part of a city's meshes that is on the GPU. It comes in pieces of a layer, of some thousand vertices each, when
/// they are first in sight; they go when others need their place, those first that have not been seen for longest. So
/// what is held follows what was looked at, not how large the city is.
///   CityMeshes meshes(scene);
///   meshes.bring(scene, objects, detail, bytes_of_this_frame);
///   std::size_t n = make_commands(scene.buildings.table, meshes.buildings, Paint::facade, objects, out).commands;
#include <optional>

#include "gl/ranges.h"
#include "scenegraph/draw/city_pieces.h"

namespace manzana::draw {

class CityMeshes {
 public:
  /// Throws std::runtime_error for 2^24 blocks or more.
  explicit CityMeshes(const Scene& scene);
  /// Buffers do not grow beyond so many bytes from now on; 0: no limit.
  void limit(std::size_t most_bytes) { most_bytes_ = most_bytes; }

  /// What is in sight of `objects` (runs of the tree's), as detailed as it must be, and not held is brought: at most so
  /// many bytes, but a piece at least, unless none are allowed. Returns how many bytes are left to bring; what there is
  /// no room for is not among them.
  std::size_t bring(const Scene& scene, std::span<const culling::ObjectRun> objects, const MeshDetail& detail,
                    std::size_t most_bytes);

  /// 0xRRGGBB a row of the layer, kOwnColour: as it was. Materials stay. Only what is held and changes is uploaded.
  void paint(const MeshLayer& layer, LayerPieces& pieces, std::span<const std::uint32_t> colours);

  LayerPieces buildings, surfaces;
  const gl::VertexArray& array() const { return array_; }
  const gl::VertexArray& fading_array() const { return fading_array_; }  ///< with shares by base instance
  std::size_t device_bytes() const;                                      ///< of the buffers
  std::size_t held_bytes() const { return held_; }                       ///< of pieces
  std::size_t seen_bytes() const { return seen_; }        ///< of pieces that have been in sight at any time
  std::size_t all_bytes() const { return all_; }          ///< of all pieces in full detail
  std::size_t missing_bytes() const { return missing_; }  ///< in sight at the last bring(), and without room

 private:
  struct Wanted {
    const MeshLayer* layer;
    LayerPieces* pieces;
    std::uint32_t item;
  };
  struct Place {
    std::uint32_t vertices, indices;
  };
  void want(const MeshLayer& layer, LayerPieces& pieces, std::span<const culling::ObjectRun> objects,
            const MeshDetail& detail);
  bool hold(const Wanted& wanted);
  std::optional<Place> take(const Piece& piece);
  bool make_room(const Piece& piece);
  bool grow(const Piece& piece);
  bool release_before(std::uint64_t frame);
  void release(LayerPieces& layer, std::size_t piece);
  void upload(const Wanted& wanted, const Place& place);
  void put_vertices(std::uint32_t at, const CityMesh& mesh);
  std::size_t bytes_for(std::size_t vertices, std::size_t indices) const;
  void resize(std::uint32_t vertices, std::uint32_t indices);

  bool textured_;
  std::size_t most_bytes_ = 0;
  gl::VertexArray array_, fading_array_;
  gl::Buffer vertices_, indices_, shares_;
  gl::Buffer textures_;  ///< a row a vertex; only of a scene with pictures
  gl::Ranges vertex_room_, index_room_;
  std::vector<Wanted> wanted_;
  std::uint64_t frame_ = 0;
  std::size_t held_ = 0, seen_ = 0, all_ = 0, missing_ = 0;
};

/// Commands for what is held and shown of the runs, adjacent ones merged: `whole` of pieces that show one item, else of
/// those that show two. `out` has room for most_commands().
Drawn make_commands(const LayerTable& table, const LayerPieces& layer, Paint paint,
                    std::span<const culling::ObjectRun> runs, gl::DrawCommand* out, bool whole = true);
/// `objects`: runs of the tree's. `fading`: what pieces between two levels are painted with; only if there are levels.
Drawn draw_city(const CityMeshes& meshes, const LayerTable& table, const LayerPieces& layer,
                const PaintPrograms& paints, const PaintPrograms& fading, std::span<const culling::ObjectRun> objects,
                gl::StreamBuffer& stream);
std::size_t stream_bytes(const LayerPieces& layer, std::size_t runs);

inline std::size_t most_commands(const LayerPieces& layer, std::size_t runs, bool whole = true) {
  return (runs + layer.count) * (whole ? 1 : 2);
}

}  // namespace manzana::draw

#pragma once
/// Counts what can be seen of cells of leaves on the GPU, for bake_visibility() (foliage/cell_visibility.h).
///   CellCounterGl counter(plant, CountBy::ids);
///   bake_visibility(plant, {}, std::ref(counter));
/// Leaves framebuffer, program, buffer bindings, depth and scissor state changed; waits for the GPU at each view.
#include "foliage/cell_visibility.h"
#include "gl/handle.h"

namespace manzana::foliage {

enum class CountBy : std::uint8_t {
  ids,     ///< two pictures of cell ids, of all cells and of each cell apart, and a histogram of each
  queries  ///< [Gumbau 2009, algorithm 1] draws with occlusion queries: a cell's leaves alone for their depth, again
           ///< for their count; the whole plant for its depth, then the cell's leaves for their count. The third is the
           ///< same for all cells of a view and drawn once. Counts fragments: leaves of a cell that lie in each other
           ///< count more than once, and of cells that do, each is seen.
};

/// A CountPixels; the plant must stay as it is.
class CellCounterGl {
 public:
  /// Throws std::runtime_error when a shader does not compile or the device has no room.
  CellCounterGl(const PreparedPlant& plant, CountBy by);
  CellPixels operator()(const ParallelView& view, std::optional<std::uint32_t> only = {});

 private:
  struct Picture {
    int side = 0;
    gl::Texture ids, depth;
    gl::Framebuffer framebuffer;
  };
  static Picture make_picture(int side);

  bool is_leaf(const CellPiece& piece) const { return piece.cell < cells_; }
  Run in_buffer(const CellPiece& piece) const;
  std::vector<CellPiece> pieces_in(const ParallelView& view) const;
  void make_room(int side);
  void set_view(const ParallelView& view);
  void begin(const Picture& picture, int pixels, bool apart);
  void draw(std::span<const CellPiece> pieces) const;
  void count_ids(const Picture& picture, int pixels, std::uint32_t first) const;

  void count_by_ids(std::span<const CellPiece> own, std::span<const CellPiece> all, const ParallelView& view);
  CellPixels count_from_front(const ParallelView& view, std::optional<std::uint32_t> only);
  void count_apart(std::span<const CellPiece> cells, const ParallelView& view);
  CellPixels counted() const;
  CellPixels count_by_queries(std::span<const CellPiece> own, std::span<const CellPiece> all, const ParallelView& view);

  CountBy by_;
  std::uint32_t cells_, leaves_;
  std::vector<CellPiece> pieces_;
  gl::Buffer quads_, cell_of_, tiles_, counts_;
  gl::Texture opaque_;
  gl::Program draw_, histogram_;
  gl::VertexArray array_;
  Picture all_, apart_;
};

}  // namespace manzana::foliage

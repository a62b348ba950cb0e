#include "foliage/cell_pieces.h"

#include <algorithm>

namespace manzana::foliage {
namespace {

constexpr std::uint32_t kBarkPiece = 64;  // quads; branch after branch, so near each other

CellPiece make_piece(const std::vector<PlantQuad>& all, const Run& quads, std::uint32_t cell) {
  Vec3 low(3e38F), high(-3e38F);
  for (std::uint32_t q = quads.first; q < quads.last; ++q)
    for (const PlantQuad::Corner& c : all[q].corners)
      low = glm::min(low, c.position), high = glm::max(high, c.position);
  return {quads, cell, 0.5F * (low + high), 0.5F * (high - low)};
}

}  // namespace

std::vector<CellPiece> pieces_of(const PreparedPlant& plant) {
  std::vector<CellPiece> pieces;
  const auto cells = static_cast<std::uint32_t>(plant.cells.size());
  const Run bark = finest_bark(plant);
  for (std::uint32_t first = bark.first; first < bark.last; first += kBarkPiece)
    pieces.push_back(make_piece(plant.bark, {first, std::min(first + kBarkPiece, bark.last)}, cells));
  for (std::uint32_t c = 0; c < cells; ++c)
    if (plant.cells[c].quads.size() > 0) pieces.push_back(make_piece(plant.leaves, plant.cells[c].quads, c));
  return pieces;
}

PixelBox pixels_of(const CellPiece& piece, const ParallelView& view) {
  const Vec2 middle = view.pixel(piece.middle);
  const Vec2 half(view.pixels_of(glm::dot(piece.half, glm::abs(view.right()))),
                  view.pixels_of(glm::dot(piece.half, glm::abs(view.up()))));
  const Vec2 end(static_cast<float>(view.pixels()));
  return {glm::ivec2(glm::clamp(glm::floor(middle - half) - 1.0F, Vec2(0), end)),
          glm::ivec2(glm::clamp(glm::ceil(middle + half) + 1.0F, Vec2(0), end))};
}

}  // namespace manzana::foliage

#pragma once
/// All triangles of a city, in the order in which a structure keeps its objects: a run of positions is one run of
/// corners and one of indices, so that it is drawn by one command, or sent again by two copies.
///   Geometry rows = make_geometry(city);                     // once a city
///   Geometry own = arranged(rows, peer->order());            // once a structure
#include <span>

#include "apps/culling_benchmark/paper_mesh.h"

namespace manzana::paper {

struct Geometry {
  std::vector<Corner> corners;
  std::vector<std::uint32_t> indices;          ///< from the first of `corners`
  std::vector<std::uint32_t> first_corner{0};  ///< objects + 1
  std::vector<std::uint32_t> first_index{0};   ///< objects + 1
  std::size_t objects() const { return first_index.size() - 1; }
};

void append(Geometry& geometry, const Mesh& mesh);
/// By rows of the city.
Geometry make_geometry(const baselines::City& city);
/// By an order of those rows (position -> row); an empty one leaves them as they are.
Geometry arranged(const Geometry& rows, std::span<const std::uint32_t> order);

}  // namespace manzana::paper

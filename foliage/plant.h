#pragma once
/// A plant as its sources have it: branches and terminal nodes (leaves, flowers, fruit), never mixed. [Gadbem 2011,
/// section 3.3.1]
///   Plant oak = grow_plant(species, seed);      // foliage/generate.h
///   Plant pine = read_plant("pine.glb");        // foliage/import: glTF, OBJ, L-systems
///   PreparedPlant ready = prepare(oak);         // foliage/prepare.h
/// Flat: a branch is a row, after its parent; its triangles and its centre line are runs.
#include <cstdint>
#include <string>
#include <vector>

#include "foliage/image.h"
#include "foliage/plant_mesh.h"

namespace manzana::foliage {

/// Half-open.
struct Run {
  std::uint32_t first = 0, last = 0;
  std::uint32_t size() const { return last - first; }
  bool operator==(const Run&) const = default;
};

struct CentrePoint {
  Vec3 position;  ///< metres
  float radius;
};

struct Branch {
  std::int32_t parent = -1;  ///< a row before this one; -1: it grows out of the ground
  std::uint16_t level = 0;   ///< 0 trunk
  Run line;                  ///< of Plant::centre_lines, from foot to tip, at least two points; empty: not known
  Run triangles;             ///< of Plant::mesh.bark; may be empty
};

enum class Organ : std::uint8_t { leaf, flower, fruit };

/// What a branch ends in: a leaf card, a modelled leaf of many triangles, a petal.
struct Terminal {
  Run triangles;             ///< of Plant::mesh.leaves; at least one
  std::int32_t branch = -1;  ///< that carries it; -1: not known
  Organ organ = Organ::leaf;
};

/// Metres, z up, the foot at the origin. The runs of branches, and those of terminals, are in order, apart, and cover
/// all triangles of their part.
struct Plant {
  std::string name;
  PlantMesh mesh;
  std::vector<Branch> branches;
  std::vector<CentrePoint> centre_lines;
  std::vector<Terminal> terminals;
  Image leaf_image, bark_image;
};

/// Throws std::invalid_argument, naming the row, for what breaks the rules above, is not finite, or lies more than
/// 1000 km away. Linear.
void check(const Plant& plant);

}  // namespace manzana::foliage

#pragma once
/// The skeleton of a tree after Weber and Penn 1995: stems as curved, tapered centre lines, and the places of the leaf
/// cards. Metres, z up, the foot at the origin.
#include <vector>

#include "foliage/generate.h"

namespace manzana::foliage {

/// One end of a segment. The columns of the frame are the stem's own x, y, and its heading z.
struct StemPoint {
  Vec3 position;
  Mat3 frame;
  float radius;
};

struct Stem {
  int parent = -1;  ///< its index in Skeleton::stems; of a clone: the stem that split
  int level = 0;
  float length = 0;
  std::vector<StemPoint> points;  ///< at least two
};

/// A leaf card's foot, the direction it grows to, and its size: cards of short stems are smaller. Likewise an organ's.
struct LeafSite {
  Vec3 foot, axis;
  float scale = 1;
  int stem = -1;  ///< its index in Skeleton::stems
};

struct Skeleton {
  std::vector<Stem> stems;  ///< a parent precedes its children
  std::vector<LeafSite> leaves;
  std::vector<LeafSite> organs;  ///< flowers or fruit
};

inline constexpr std::size_t kMaxPlantVertices = 1'000'000;
/// Vertices of the tube around a stem, and round its girth: few on twigs.
int stem_sides(int level);
std::size_t stem_vertices(const Stem& stem);

/// [Weber and Penn, section 4.3] Relative length of a branch by the envelope's shape; ratio 1 at the crown's base, 0 at
/// its top.
float shape_ratio(int shape, float ratio);

/// Throws std::invalid_argument for parameters out of range, or more than kMaxPlantVertices in all.
Skeleton grow(const SpeciesParams& species, std::uint64_t seed);

}  // namespace manzana::foliage

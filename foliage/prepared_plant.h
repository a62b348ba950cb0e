#pragma once
/// A plant prepared for drawing at every distance; made by prepare() (foliage/prepare.h), kept on disk by
/// foliage/import/plant_cache.h, chosen from by foliage/select.h, drawn by foliage/gl.
///   near: a level of bark quads, leaf quads of each cell, and ribbons for the branches that the level left out;
///   far:  fewer leaf quads of each cell, scaled up; then points instead of quads; fewer ribbons.
/// Every list is in an order of which a prefix is a fair sample: fewer is always "the first so many".
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "foliage/plant.h"

namespace manzana::foliage {

/// Everything here is in metres, z up, the foot at the origin, and of the plant's natural size.
/// 96 bytes, as std430 has it. A triangle is a quad whose corners 2 and 3 are one. Triangles 0-1-2, 0-2-3.
struct PlantQuad {
  struct Corner {
    Vec3 position;
    std::uint16_t u, v;  ///< unsigned normalised, times kUvRange
  };
  std::array<Corner, 4> corners;
  std::array<std::uint32_t, 4> normals;  ///< pack_normal; two upper bits: the branch's level, at most 3, for the wind
  Vec3 anchor;                           ///< leaves: the petiole, about which it is scaled
  std::array<std::uint8_t, 4> shades;    ///< of the corners: ambient light that arrives
};
static_assert(sizeof(PlantQuad) == 96);

/// 32 bytes. Stands for leaf triangles, one or many. [Deussen 2005, section 10; Gadbem 2011, section 3.5]
struct LeafPoint {
  Vec3 position;
  float area;              ///< m2 that it hides, seen from anywhere: half the triangles' area, times their alpha, times
                           ///< what is fitted for its level so that all of it cover, as squares, what the leaves do
  std::uint32_t normal;    ///< pack_normal, with the branch's level; of a grove's, with glsl::kGroveLeaf or without;
                           ///< of a branch's point its direction (foliage/branch_points.h)
  std::uint32_t colour;    ///< sRGB, r lowest: mean of the texels in linear light, weighted by alpha; highest byte: the
                           ///< standard deviation of what it stands for over the mean, in 255ths
  float shade;             ///< in [0, 1], or a little more: foliage/point_shade.h
  std::uint32_t tree = 0;  ///< of a grove's: the hash of its tree, as TreeSite has it
};
static_assert(sizeof(LeafPoint) == 32);

constexpr std::uint32_t kOfLeaf = ~0U;

/// 48 bytes. A piece of a branch, or a thin leaf, drawn as a ribbon that turns to the eye.
struct LineSegment {
  Vec3 a;
  float radius_a;
  Vec3 b;
  float radius_b;
  float shade;
  std::uint32_t level;       ///< of its branch; a leaf's normal, as PlantQuad's
  std::uint32_t branch;      ///< its row in Plant::branches; kOfLeaf: it is a leaf's
  std::uint32_t colour = 0;  ///< of a leaf's, as a LeafPoint's
};
static_assert(sizeof(LineSegment) == 48);

/// One mesh of branches, and which lines complete it.  [Gadbem 2011, section 3.4: each level is a pair (mesh, lines)]
struct BranchLevel {
  Run quads;                     ///< of PreparedPlant::bark
  std::uint32_t branches = 0;    ///< the first so many by importance are in the mesh
  std::uint32_t first_line = 0;  ///< lines [first_line, end) stand for all the others
  float error_m = 0;             ///< width of the thickest branch that is a line here; 0 at the finest
  float mesh_error_m = 0;        ///< how far the mesh is from that of the finest level
  Run steps;                     ///< of PreparedPlant::branch_steps, from the next level's branches (the last: from
              ///< none) to this level's, one more branch in the mesh with each: foliage/branch_levels.h
};

/// A pair between two levels: the level's first so many quads, and lines [first_line, end).
struct BranchStep {
  std::uint32_t quads, first_line;
  std::uint32_t branches;  ///< in the mesh
};

/// Lines for all branches, then for all thin leaves, where so much may be wrong: fewer of them, some wider.
/// foliage/line_levels.h, leaf_lines.h
struct LineLevel {
  Run lines;  ///< of PreparedPlant::coarse_lines
  float error_m = 0;
};

/// [Gumbau 2009] Leaves near each other, in an oriented box. Closed; holds every corner of its quads.
struct LeafCell {
  Vec3 centre;
  Mat3 axes;  ///< columns, orthonormal, det +1
  Vec3 half;  ///< extents along them
  Run quads;  ///< of PreparedPlant::leaves; leaves in random order, quads of a leaf together
};

/// Points merged four to one, again and again. Level 0: two a triangle, more on large leaves.
struct PointLevel {
  Run points;  ///< of PreparedPlant::points, in an order of which every prefix is spread over the crown
  float area;  ///< m2: the sum of its points'
  std::array<float, 3> between{1, 1, 1};  ///< what areas are multiplied by at a quarter, half and three quarters of the
                                          ///< way to the next level, to cover the same
};

/// Directions are those of an octahedral grid over the whole sphere: foliage/octahedral.h.
struct Visibility {
  std::uint32_t side = 0;           ///< vertices along each side of the grid; 0: not baked, all is visible
  std::vector<std::uint8_t> share;  ///< cell c, direction d: share[c * side * side + d] / 255
};

/// The eye's elevation is 0, 30, 60, 90 degrees.
inline constexpr std::size_t kGroveViews = 4;
inline constexpr std::size_t kGroveFits = 8;  ///< 1, 2, 4, ... 128 points

/// What a tree's first few points cover, and how they look, where it is one of a grove's: foliage/grove_fit.h
struct GroveFit {
  Run points;                                 ///< of PreparedPlant::points, the last: foliage/grove_points.h
  std::array<float, kGroveViews> cover_m2{};  ///< that the plant hides
  using Table = std::array<std::array<float, kGroveFits>, kGroveViews>;
  Table area{};   ///< m2
  Table light{};  ///< by what points must be lighter: few of them do not hide those within the crown, which are darker
};

struct PreparedPlant {
  std::string name;
  float height_m = 10, crown_radius_m = 3;  ///< by nature
  Image leaf_image, bark_image;

  std::vector<PlantQuad> bark;
  std::vector<BranchLevel> branch_levels;  ///< finest first
  std::vector<BranchStep> branch_steps;
  std::vector<LineSegment> lines;  ///< most important branch first; in random order those between two levels; then
                                   ///< those of thin leaves, first those that cells lose first
  std::vector<LineSegment> coarse_lines;
  std::vector<LineLevel> line_levels;      ///< finest first, each twice the error of the one before
  std::vector<std::uint32_t> line_firsts;  ///< where the lines begin of branches [b, end): for b of 0 to all, the last
                                           ///< being where leaves' begin, and where these end; of lines, then of
                                           ///< coarse_lines, level by level

  std::vector<PlantQuad> leaves;
  std::vector<LeafCell> cells;            ///< their runs are in order, apart, and cover all leaves
  std::vector<std::uint32_t> shuffled;    ///< all leaves' quads, for ways that know no cells: the large ones, then the
                                          ///< others, each in random order
  std::uint32_t large_quads = 0;          ///< L, most often 0: the first so many of shuffled
  std::vector<LeafPoint> points;          ///< of leaves, level by level; then the grove's
  std::uint32_t large_points = 0;         ///< M: points [0, M) are spread over all large quads
  std::vector<PointLevel> point_levels;   ///< finest first; level 0: four points from M + 4 (i - L) on are of quad
                                          ///< shuffled[i], i >= L
  float cover_m2 = 0;                     ///< that the plant hides, seen from its sides, mean
  float leaf_area_m2 = 0;                 ///< of all leaf quads, one side, times alpha
  std::array<float, 3> turning{1, 1, 1};  ///< what points' areas are multiplied by where they are a quarter, half and
                                          ///< three quarters of what is seen of the leaves, quads the rest
  std::array<float, 17> leaf_scale{};     ///< linear size at u = 2^(-i/2) of the leaves, fitted to coverage
  Visibility visibility;
  GroveFit grove;
};

/// Throws std::invalid_argument, naming the row, for a run that leaves its list, a list that breaks the rules above, or
/// a number that is not finite or beyond a million. Linear. What passes can be drawn.
void check(const PreparedPlant& plant);

}  // namespace manzana::foliage

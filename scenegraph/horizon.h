#pragma once
/// What stands behind buildings is not seen: from a street corner most of a city. An occlusion horizon [Downs, Moeller,
/// Sequin, "Occlusion horizons for driving through urban scenery", 2001]: for each of some thousand directions round
/// the eye, from which to which elevation nearer walls hide what is behind. Blocks come from near to far; those
/// whose whole box lies behind are taken out of what is seen, of the others the objects that do; what is left adds its
/// walls.
///   Horizon horizon(scene);
///   find_visible(scene, view, Structure::bqr, sets);
///   horizon.hide(scene, view.eye, sets);                          // each frame
///   find_cars(scene, tick, sets);
///   horizon.hide_cars(sets);
/// Conservative: a wall hides only in directions that it, or the walls that continue it, cover in full, only what is
/// farther than it anywhere there, and only if it is in the sets, so drawn. Walls with both ends upright count, of
/// whatever file. Seen from above the roofs there are none, and it costs next to nothing.
#include <optional>

#include "scenegraph/visible.h"

namespace manzana {

class Horizon {
 public:
  explicit Horizon(const Scene& scene);

  /// Of the last find_visible of the scene, without nodes; everything that the sets hold is taken as drawn, opaque, but
  /// for what is nearer than kNearest. No allocation once all walls near the eye have been found.
  void hide(const Scene& scene, const Vec3d& eye, VisibleSets& sets);
  /// After find_cars, those that the same walls hide.
  void hide_cars(VisibleSets& sets) const;
  static constexpr double kNearest = 2;  ///< metres: what is nearer may be cut away by a near plane

  /// A wall that stands upright; metres along L's axes, from its block's origin. Seen from outside it runs from left to
  /// right.
  struct Wall {
    Vec2 a{0, 0}, b{0, 0};
    float bottom = 0, top = 0;
    bool joined = false;  ///< it begins where the one before ends
  };
  struct Column {
    float low = 0, high = 0, farthest = 0;  ///< tangents of elevation; metres in plan
  };

 private:
  struct Near {
    float distance = 0;
    std::uint32_t number = 0, planes = 0;
  };
  void list_blocks(const VisibleSets& sets);
  bool hidden(const culling::BoxD& box) const;
  void keep_objects(const Scene& scene, std::uint32_t block, VisibleSets& sets);
  void add_walls(const Scene& scene, std::uint32_t block, const culling::ObjectRun& buildings);
  void add_chain(std::span<const Wall> chain, const Vec3& offset);
  void cover(std::size_t column, const Column& with);
  const std::vector<Wall>& walls_of(const Scene& scene, std::uint32_t building);

  Vec3d eye_{0, 0, 0};
  std::vector<Vec2> edges_;  ///< between columns: directions of unit length
  std::vector<Column> columns_;
  std::vector<std::optional<std::vector<Wall>>> walls_;  ///< a row a building, once it was near
  std::vector<culling::BoxD> boxes_;                     ///< a row a block, in L
  std::vector<Near> near_;                               ///< blocks of the sets, the nearest first
  std::vector<Near> objects_;                            ///< of the block at hand
};

/// The walls of a building's mesh that a horizon can use.
std::vector<Horizon::Wall> upright_walls(const Scene& scene, std::uint32_t building);

}  // namespace manzana

#pragma once
/// What stands behind buildings is not seen: from a street corner most of a city. An occlusion horizon [Downs, Moeller,
/// Sequin, "Occlusion horizons for driving through urban scenery", 2001]: for each of some thousand directions round
/// the eye, from which to which elevation nearer walls hide what is behind. Blocks come from near to far; those
/// whose whole box lies behind are taken out of what is seen, of the others the objects that do; what is left adds its
/// walls.
///   Horizon horizon(scene);
///   find_visible(scene, view, Structure::bqr, sets);
///   horizon.hide(scene, {view.eye, sets.frustum.planes[culling::kNear]}, sets);    // each frame
///   find_cars(scene, tick, sets);
///   horizon.hide_cars(sets);
/// Conservative: a wall hides only in directions that it, or the walls that continue it, cover in full, only what is
/// farther than it anywhere there, and only if it is drawn: in the sets, beyond the near plane, on the device. What
/// stands upright counts, of whatever file (upright_walls.h). Seen from above the roofs there is none, and it costs
/// next to nothing. It is about an eye: an orthographic view has none.
#include <functional>
#include <optional>

#include "scenegraph/upright_walls.h"
#include "scenegraph/visible.h"

namespace manzana {

class Horizon {
 public:
  explicit Horizon(const Scene& scene);

  struct Eye {
    Vec3d at{0, 0, 0};
    culling::PlaneD near = culling::kNoPlane;  ///< relative to it: what is before it is cut away
  };
  /// Of the last find_visible of the scene, with a host's nodes or without; what the sets hold is taken as opaque.
  /// Nodes stay, and hide nothing. No allocation once all walls near the eye have been found.
  void hide(const Scene& scene, const Eye& eye, VisibleSets& sets);
  /// Of a building's row: whether it is on the device.
  using IsThere = std::function<bool(std::uint32_t row)>;
  /// After hide(): what is not there yet hides nothing, though things that it will hide are still not brought
  /// (VisibleSets::to_bring). Costs a second sweep where something in sight is missing.
  void reveal(const Scene& scene, VisibleSets& sets, const IsThere& there);
  /// After find_cars, those that the same walls hide.
  void hide_cars(VisibleSets& sets) const;
  static constexpr double kNearest = 2;  ///< metres: nearer walls hide nothing

  struct Column {
    float low = 0, high = 0, farthest = 0;  ///< tangents of elevation; metres in plan
  };

 private:
  struct Near {
    float distance = 0;
    std::uint32_t number = 0, planes = 0;
  };
  struct Facing {
    Vec2 normal{0, 0};  ///< of a wall's plane, away from the eye
    float away = 0;
    float lean = 0;  ///< metres by which its top or bottom is off the plane, at most
  };
  void list_blocks(const VisibleSets& sets);
  /// Of what a box covers: columns [first, last], tangents of elevation, metres in plan.
  struct Sight {
    std::int64_t first = 0, last = 0;
    float low = 0, high = 0, nearest = 0;
  };
  Sight sight_of(const culling::BoxD& box) const;
  bool hidden(const culling::BoxD& box) const;
  bool may_hide_part(const culling::BoxD& box) const;
  void sweep(const Scene& scene, VisibleSets& sets, const IsThere& there);
  void keep_objects(const Scene& scene, std::uint32_t block, VisibleSets& sets, const IsThere& there);
  void keep_nearest_first(const Scene& scene, std::uint32_t block, VisibleSets& sets, const IsThere& there);
  bool is_cut(const Vec2& at, const UprightWall& wall, float up, float lean) const;
  void add_walls(const Scene& scene, std::uint32_t block, const culling::ObjectRun& buildings);
  void add_chain(const Vec3& offset, float lean);
  Column seen_in(std::size_t column, const UprightWall& wall, const Facing& facing, float up) const;
  void cover(std::size_t column, const Column& with);
  const std::vector<UprightWall>& walls_of(const Scene& scene, std::uint32_t building);

  Vec3d eye_{0, 0, 0};
  culling::Plane near_plane_;  ///< relative to it
  std::vector<Vec2> edges_;    ///< between columns: directions of unit length
  std::vector<Column> columns_;
  std::vector<std::optional<std::vector<UprightWall>>> walls_;  ///< a row a building, once it was near
  std::vector<UprightWall> chain_;                              ///< at hand, as it is seen
  std::vector<culling::BoxD> boxes_;                            ///< a row a block, in L
  std::vector<Near> near_;                                      ///< blocks of the sets, the nearest first
  std::vector<Near> objects_;                                   ///< of the block at hand
};

}  // namespace manzana

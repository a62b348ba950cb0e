#pragma once
/// Where a scene lies on the Earth. Files speak WGS 84; a scene speaks metres in a frame L of its own: x east, y north,
/// z up at the anchor. Away from the anchor the ground falls below z = 0 (7.9 m at 10 km) and its up tilts, so heights
/// above ground go through ground_z() and up_at(), and every block has a frame B of its own.
///   LocalFrame frame({60.17, 24.94, 0});
///   Vec3d p = frame.to_local({60.1712, 24.9414, 12});
/// Holds at the poles and across the antimeridian, because everything goes through earth-centred coordinates. [numerics
/// 6]
#include <GeographicLib/LocalCartesian.hpp>
#include <span>

#include "culling/vec.h"

namespace manzana {

/// WGS 84; height above the ellipsoid.
struct GeoPoint {
  double lat_deg = 0, lon_deg = 0, height_m = 0;
};
/// Finite, latitude within [-90, 90]. Longitudes beyond +-180 are wrapped by GeographicLib and valid up to +-540.
bool valid(const GeoPoint& point);

/// The point of the ellipsoid below the mean of the points' earth-centred positions: longitudes are never averaged.
/// Points that are not valid are passed over; none left: {0, 0, 0}.
GeoPoint center_of(std::span<const GeoPoint> points);

/// Likewise, of the medians of the positions' components: a few strays do not draw it aside.
GeoPoint median_of(std::span<const GeoPoint> points);

class LocalFrame {
 public:
  /// Throws std::invalid_argument when the anchor is not valid.
  explicit LocalFrame(const GeoPoint& anchor = {});
  const GeoPoint& anchor() const { return anchor_; }
  /// Asserts valid(point). Error under 5 nm.
  Vec3d to_local(const GeoPoint& point) const;
  GeoPoint to_geo(const Vec3d& local) const;
  /// z in L of the ellipsoid's surface over the plan position (x, y), metres; closed form, within 1e-8 m up to 1000 km.
  double ground_z(const Vec2d& plan) const;
  /// The ellipsoid's outward unit normal there, in L.
  Vec3d up_at(const Vec2d& plan) const;

 private:
  GeoPoint anchor_;
  GeographicLib::LocalCartesian projection_;
  Mat3d axes_;      // columns: east, north, up of the anchor, in earth-centred axes scaled to the unit sphere
  Vec3d position_;  // the anchor, in the same
};

/// A block's own frame B: metres from `origin`, z along the ellipsoid's up there; x leans on L's x as nearly as it can.
struct BlockFrame {
  Vec3d origin{0, 0, 0};  ///< in L, on the ellipsoid
  Mat3d axes{1.0};        ///< columns: B's x, y, z in L; orthonormal, right-handed
  Vec3d to_block(const Vec3d& local) const { return glm::transpose(axes) * (local - origin); }
  Vec3d to_local(const Vec3d& block) const { return origin + axes * block; }
};
BlockFrame block_frame(const LocalFrame& frame, const Vec2d& plan_center);

/// The point h metres above the ground at a plan position, in B.
inline Vec3d ground_point(const LocalFrame& frame, const BlockFrame& block, const Vec2d& plan, double h = 0) {
  Vec3d p = block.to_block({plan.x, plan.y, frame.ground_z(plan)});
  p.z += h;
  return p;
}

}  // namespace manzana

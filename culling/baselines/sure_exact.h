#pragma once
/// The answers of culling/baselines/exact.h at a small part of its cost: separating axes in double, and what rounding
/// could change is left to long double.
///   const SureExact exact(view);
///   bool seen = exact.overlaps(box);                            // == exactly_overlaps(view, box), always
///   std::vector<std::uint64_t> bits = exact.visible(boxes);     // bit i % 64 of word i / 64 is box i's; on all cores
#include <cstdint>

#include "culling/baselines/exact.h"

namespace manzana::culling {

class SureExact {
 public:
  explicit SureExact(const View& view);
  bool overlaps(const BoxD& box) const;
  std::vector<std::uint64_t> visible(std::span<const BoxD> boxes) const;

 private:
  struct Axis {
    Vec3d direction, size;  ///< and the absolute values of its components
    double low, high;       ///< what the camera sees lies between; may be infinite
    double margin;          ///< that the rounding of these two needs
  };
  /// `apart`: certainly, along some axis; `meets`: certainly, along all.
  enum class Verdict { apart, meets, doubt };
  static Verdict along(const Axis& axis, const Vec3d& low, const Vec3d& high);
  bool holds(const Vec3d& point) const;
  Verdict verdict(const BoxD& box) const;

  ExactView exact_;
  Vec3d eye_;
  std::vector<Axis> axes_;  ///< those of the frustum's own faces first
};

}  // namespace manzana::culling

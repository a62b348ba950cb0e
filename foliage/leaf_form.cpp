#include "foliage/leaf_form.h"

#include <algorithm>
#include <cmath>

#include "foliage/obb_cells.h"

namespace manzana::foliage {
namespace {

Vec3d corner(const PlantQuad& quad, std::size_t k) { return Vec3d(quad.corners[k % 4].position); }

/// A side of a quad, seen as an end of a ribbon.
struct End {
  Vec3d middle;
  double width;
};

End side(const PlantQuad& quad, std::size_t k) {
  const Vec3d a = corner(quad, k), b = corner(quad, k + 1);
  return {0.5 * (a + b), glm::distance(a, b)};
}

}  // namespace

LeafForm leaf_form(std::span<const PlantQuad> quads, double alpha) {
  std::vector<Vec3d> corners;
  double sum = 0;
  for (const PlantQuad& quad : quads) {
    sum += quad_area(quad);
    for (std::size_t k = 0; k < 4; ++k) corners.push_back(corner(quad, k));
  }
  const OrientedBox box = fit_box(corners);
  int longest = 0;
  for (int k = 1; k < 3; ++k)
    if (box.half[k] > box.half[longest]) longest = k;
  LeafForm form;
  form.length = 2 * static_cast<double>(box.half[longest]);
  form.axis = Vec3d(box.axes[longest]);
  double across = 0;
  for (int k = 0; k < 3; ++k)
    if (k != longest) across = std::max(across, 2 * static_cast<double>(box.half[k]));
  constexpr double kSlim = 0.3;  // a blade may bend
  form.width = across > kSlim * form.length ? across : sum * alpha / form.length;
  return form;
}

/// Between the two opposite sides that lie farther apart along the axis.
LineSegment leaf_line(const PlantQuad& quad, const Vec3d& axis, double alpha) {
  std::array<End, 2> best{side(quad, 0), side(quad, 2)}, other{side(quad, 1), side(quad, 3)};
  const auto reach = [&](const std::array<End, 2>& ends) {
    return std::abs(glm::dot(ends[1].middle - ends[0].middle, axis));
  };
  if (reach(other) > reach(best)) std::swap(best, other);
  LineSegment line{};
  line.a = Vec3(best[0].middle);
  line.b = Vec3(best[1].middle);
  line.radius_a = static_cast<float>(0.5 * alpha * best[0].width);
  line.radius_b = static_cast<float>(0.5 * alpha * best[1].width);
  line.shade = static_cast<float>(quad.shades[0]) / 255;
  line.level = quad.normals[0];
  line.branch = kOfLeaf;
  return line;
}

}  // namespace manzana::foliage

#include "apps/foliage_benchmark/grey_crown.h"

#include <limits>

#include "apps/foliage_benchmark/sheet.h"
#include "foliage/octahedral.h"
#include "foliage/raster.h"

namespace manzana::foliage_benchmark {
namespace {

using foliage::PlantQuad;
using foliage::PreparedPlant;

/// Of a cell, from far away on that side.
float share_seen(const PreparedPlant& plant, std::size_t cell, const Vec3& to_camera) {
  const std::uint32_t side = plant.visibility.side;
  if (side == 0) return 1;
  const foliage::GridWeights grid = foliage::grid_weights(side, to_camera);
  std::uint32_t sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    sum += grid.weight[k] * plant.visibility.share[cell * side * side + grid.vertex[k]];
  return static_cast<float>(sum) / (256 * 255);
}

/// By parallel rays, the nearest counts.
class GreyPicture {
 public:
  GreyPicture(const PreparedPlant& plant, const Vec3d& to_eye, int pixels)
      : holes_(plant.leaf_image),
        view_(view_of(plant, to_eye, pixels)),
        near_(static_cast<std::size_t>(pixels) * static_cast<std::size_t>(pixels), -std::numeric_limits<float>::max()),
        picture_(make_picture(pixels, pixels)) {}

  void draw(const PlantQuad& quad, bool leaf, const Vec3& light) {
    std::array<Vec2, 4> at;
    std::array<float, 4> near;
    for (std::size_t c = 0; c < 4; ++c) {
      at[c] = view_.pixel(quad.corners[c].position);
      near[c] = view_.nearness(quad.corners[c].position);
    }
    const foliage::QuadUv uv(quad);
    foliage::for_each_quad_span(at, form_of(quad, uv), view_.pixels(), [&](const auto& span, const auto& part) {
      const foliage::Along depth(span, near, part), u(span, uv.u, part), v(span, uv.v, part);
      for (int i = 0; i < span.last - span.first; ++i)
        if (!leaf || holes_.opaque(u[i], v[i])) touch(span.first + i, span.y, depth[i], light);
    });
  }
  const Picture& picture() const { return picture_; }

 private:
  void touch(int x, int y, float near, const Vec3& light) {
    float& nearest =
        near_[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) + static_cast<std::size_t>(x)];
    if (near < nearest) return;
    nearest = near;
    picture_.at(x, y) = Vec4(light, 1);
  }

  foliage::LeafHoles holes_;
  foliage::ParallelView view_;
  std::vector<float> near_;
  Picture picture_;
};

Picture seen_from(const PreparedPlant& plant, const Vec3d& to_eye, const Vec3& to_camera, int pixels) {
  constexpr Vec3 kBark{0.12F, 0.06F, 0.02F};
  GreyPicture grey(plant, to_eye, pixels);
  const foliage::Run bark = finest_bark(plant);
  for (std::uint32_t i = bark.first; i < bark.last; ++i) grey.draw(plant.bark[i], false, kBark);
  for (std::size_t cell = 0; cell < plant.cells.size(); ++cell) {
    const Vec3 light(share_seen(plant, cell, to_camera));
    const foliage::Run quads = plant.cells[cell].quads;
    for (std::uint32_t i = quads.first; i < quads.last; ++i) grey.draw(plant.leaves[i], true, light);
  }
  return padded(trimmed(grey.picture()), 8);
}

}  // namespace

Picture grey_crown(const PreparedPlant& plant, int pixels) {
  const Vec3 camera(1, 0, 0);
  const std::array parts{seen_from(plant, Vec3d(camera), camera, pixels), seen_from(plant, {0, -1, 0}, camera, pixels)};
  return beside(parts, 16);
}

}  // namespace manzana::foliage_benchmark

// Sizes of few leaves: the crown covers what it did, from views that were not fitted as well.
#include "foliage/leaf_scale.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "foliage/cell_visibility.h"
#include "foliage/generate.h"
#include "foliage/import/gltf_plant.h"
#include "foliage/import/species.h"
#include "foliage/lod_factor.h"
#include "foliage/octahedral.h"
#include "foliage/prepare.h"
#include "foliage/raster.h"
#include "tests/foliage/plant_checks.h"
#include "tests/support/data.h"

namespace manzana::foliage {
namespace {

PreparedPlant grown(const char* species) {
  PreparedPlant plant = prepare(grow_plant(builtin_species(species), 3));
  plant.bark.clear();
  plant.branch_levels.clear();
  // Without area, to give all pictures one frame.
  for (const float end : {-1.0F, 1.0F}) {
    PlantQuad quad{};
    for (auto& corner : quad.corners) corner.position = Vec3(0, 0, plant.height_m / 2) + Vec3(end * 2 * plant.height_m);
    plant.bark.push_back(quad);
  }
  return plant;
}

PreparedPlant thinned(const PreparedPlant& full, double u, float scale) {
  PreparedPlant few = full;
  few.leaves.clear();
  few.cells.clear();
  for (std::uint32_t c = 0; c < full.cells.size(); ++c) {
    LeafCell cell = full.cells[c];
    const auto first = static_cast<std::uint32_t>(few.leaves.size());
    const auto count = static_cast<std::uint32_t>(kept(cell.quads.size(), u, cell_threshold(c)));
    for (std::uint32_t q = cell.quads.first; q < cell.quads.first + count; ++q) {
      few.leaves.push_back(full.leaves[q]);
      for (std::size_t k = 0; k < 4; ++k)
        few.leaves.back().corners[k].position = scaled_corner(full.leaves[q], k, scale);
    }
    few.cells.push_back({cell.centre, cell.axes, cell.half, {first, static_cast<std::uint32_t>(few.leaves.size())}});
  }
  return few;
}

constexpr int kPixels = 1024;

std::vector<Vec3d> directions() {
  std::vector<Vec3d> out;
  for (const std::uint32_t d : {1U, 5U, 6U, 7U, 11U, 13U}) out.push_back(grid_direction(5, d % 5, d / 5));
  return out;
}

double covered(const PreparedPlant& plant) {
  double sum = 0;
  for (const Vec3d& to_eye : directions()) {
    const CellPixels pixels = CellCounter(plant)(view_of(plant, to_eye, kPixels));
    for (const std::uint32_t seen : pixels.seen) sum += seen;
  }
  return sum;
}

/// An oracle: a view from the side, every sample against every triangle. Its frame is twice the rectangle of the
/// plant's size, as few large leaves reach beyond it.
struct SideView {
  static constexpr int kSide = 240, kPlant = kSide / 2;
  const PreparedPlant& plant;
  double angle;
  std::vector<char> hit = std::vector<char>(std::size_t{kSide} * kSide, 0);

  struct Corner {
    double x, y, u, v;
  };
  Corner project(const PlantQuad::Corner& c) const {
    const double across =
        static_cast<double>(c.position.x) * std::cos(angle) + static_cast<double>(c.position.y) * std::sin(angle);
    return {across / static_cast<double>(plant.crown_radius_m) * kPlant / 2 + kSide / 2,
            static_cast<double>(c.position.z / plant.height_m) * kPlant + kPlant / 2, c.u * 8.0 / 65535,
            c.v * 8.0 / 65535};
  }

  bool hole(double u, double v) const {
    const int x = static_cast<int>(u * 256) & 255, y = static_cast<int>(v * 256) & 255;
    return plant.leaf_image.rgba[static_cast<std::size_t>(4 * (y * 256 + x) + 3)] < 128;
  }

  void triangle(const Corner& a, const Corner& b, const Corner& c, bool leaf) {
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (area == 0) return;
    const int x0 = std::max(0, static_cast<int>(std::min({a.x, b.x, c.x}))),
              y0 = std::max(0, static_cast<int>(std::min({a.y, b.y, c.y})));
    for (int y = y0; y < kSide && y <= std::max({a.y, b.y, c.y}); ++y) {
      for (int x = x0; x < kSide && x <= std::max({a.x, b.x, c.x}); ++x) {
        const double px = x + 0.5, py = y + 0.5;
        const double wb = ((px - a.x) * (c.y - a.y) - (py - a.y) * (c.x - a.x)) / area;
        const double wc = ((b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x)) / area;
        if (wb < 0 || wc < 0 || wb + wc > 1) continue;
        if (!leaf || !hole(a.u + wb * (b.u - a.u) + wc * (c.u - a.u), a.v + wb * (b.v - a.v) + wc * (c.v - a.v)))
          hit[static_cast<std::size_t>(y * kSide + x)] = 1;
      }
    }
  }

  void quad(const PlantQuad& quad, bool leaf) {
    const Corner a = project(quad.corners[0]), c = project(quad.corners[2]);
    triangle(a, project(quad.corners[1]), c, leaf);
    triangle(a, c, project(quad.corners[3]), leaf);
  }
};

/// Of the plant's rectangle.
double covered_share(const PreparedPlant& plant, double angle) {
  SideView view{plant, angle};
  for (std::uint32_t q = finest_bark(plant).first; q < finest_bark(plant).last; ++q) view.quad(plant.bark[q], false);
  for (const PlantQuad& quad : plant.leaves) view.quad(quad, true);
  return static_cast<double>(std::count(view.hit.begin(), view.hit.end(), 1)) / (SideView::kPlant * SideView::kPlant);
}

/// Few leaves of a whole plant, from sides that were not fitted.
void check_coverage_kept(const PreparedPlant& plant) {
  double all = 0;
  constexpr double kAngles[] = {0.0, 0.8, 1.8, 2.8};
  for (const double angle : kAngles) all += covered_share(plant, angle) / 4;
  CHECK(all > 0.15);
  for (const std::size_t i : {4U, 8U, 12U}) {
    const double u = std::exp2(-0.5 * static_cast<double>(i));
    const PreparedPlant few = thinned(plant, u, plant.leaf_scale[i]);
    double now = 0;
    for (const double angle : kAngles) now += covered_share(few, angle) / 4;
    INFO(plant.name << " u " << u << ": " << all << " and " << now << ", of " << plant.leaves.size() << " leaves "
                    << few.leaves.size());
    CHECK(std::abs(now / all - 1) < 0.15);
  }
}

}  // namespace

TEST_CASE("few leaves of every species cover with the bark what all do, within 15 per cent, from the side") {
  for (const std::string_view species : kSpeciesNames)
    for (const std::uint64_t seed : {1, 5})
      check_coverage_kept(prepared_blind(grow_plant(builtin_species(species), seed)));
}

TEST_CASE("few leaves of a real tree cover with the bark what all do, within 15 per cent, from the side") {
  for (const char* name : {"trees/oak_medium.glb", "treemodel/eztree-bush_1.glb", "treemodel/eztree-aspen_small.glb"}) {
    const auto file = data_file(name);
    if (!file) return;
    check_coverage_kept(prepared_blind(read_plant(*file)));
  }
}

TEST_CASE("few leaves at the fitted size cover what all did") {
  const PreparedPlant plant = grown("oak");
  REQUIRE(plant.leaves.size() > 1000);
  const LeafScaleFit fit = fit_leaf_scale(plant);
  CHECK(std::is_sorted(fit.scale.begin(), fit.scale.end()));
  CHECK(fit.scale[0] == 1);
  const double all = covered(plant);
  for (const std::size_t i : {1U, 2U, 4U, 6U}) {
    const double u = std::exp2(-0.5 * static_cast<double>(i));
    double mean = 0;
    for (const float r : fit.residual[i]) mean += static_cast<double>(r) / LeafScaleFit::kViews;
    CHECK(mean == Approx(0).margin(0.005));
    const double now = covered(thinned(plant, u, fit.scale[i])) / all,
                 by_area = covered(thinned(plant, u, static_cast<float>(1 / std::sqrt(u)))) / all,
                 unscaled = covered(thinned(plant, u, 1)) / all;
    INFO("u " << u << " scale " << fit.scale[i] << " fitted " << now << " by area " << by_area << " as they are "
              << unscaled);
    CHECK(now == Approx(1).margin(0.04));
    CHECK(by_area > now);
    CHECK(unscaled < now);
  }
}

TEST_CASE("every level of points covers what the leaves do") {
  PreparedPlant plant = grown("oak");
  const double wanted = covered(plant);
  REQUIRE(plant.point_levels.size() > 3);
  // The squares of a level as quads that turn to each of the views.
  for (std::size_t i = 0; i < plant.point_levels.size(); ++i) {
    double sum = 0;
    for (const Vec3d& to_eye : directions()) {
      const ParallelView view = view_of(plant, to_eye, kPixels);
      std::vector<bool> hits(std::size_t{kPixels} * kPixels);
      const Run points = plant.point_levels[i].points;
      for (std::uint32_t p = points.first; p < points.last; ++p) {
        const Vec2 c = view.pixel(plant.points[p].position);
        const float half = 0.5F * view.pixels_of(std::sqrt(plant.points[p].area));
        const auto set = [&](const PixelSpan& span) {
          for (int x = span.first; x < span.last; ++x) hits[static_cast<std::size_t>(span.y * kPixels + x)] = true;
        };
        for (const float turn : {-1.0F, 1.0F})
          for_each_span({c + Vec2(-half), c + Vec2(half), c + Vec2(half, -half) * turn}, kPixels, set);
      }
      sum += static_cast<double>(std::count(hits.begin(), hits.end(), true));
    }
    INFO("level " << i << " of " << plant.point_levels[i].points.size());
    CHECK(sum / wanted == Approx(1).margin(i < 4 ? 0.06 : 0.2));  // fitted with the bark, which hides some of both
  }
}

TEST_CASE("leaf sizes between the fitted ones") {
  std::array<float, kLeafScales> scale{};
  for (std::size_t i = 0; i < kLeafScales; ++i) scale[i] = 1 + static_cast<float>(i);
  CHECK(leaf_scale_at(scale, 1) == 1);
  CHECK(leaf_scale_at(scale, 2) == 1);
  CHECK(leaf_scale_at(scale, std::numeric_limits<float>::quiet_NaN()) == 1);
  CHECK(leaf_scale_at(scale, 0.5F) == Approx(3));
  CHECK(leaf_scale_at(scale, std::exp2(-0.25F)) == Approx(1.5));
  CHECK(leaf_scale_at(scale, 1e-6F) == Approx(17));
  CHECK(leaf_scale_at(scale, 0) == Approx(17));
}

TEST_CASE("a plant without leaves has leaf sizes of one") {
  for (const float s : fit_leaf_scale(PreparedPlant{}).scale) CHECK(s == 1);
}

}  // namespace manzana::foliage

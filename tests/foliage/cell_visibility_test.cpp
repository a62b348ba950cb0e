// What can be seen of cells, against rays cast in double, and on plants where it is plain.
#include "foliage/cell_visibility.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "foliage/generate.h"
#include "foliage/import/gltf_plant.h"
#include "foliage/import/species.h"
#include "foliage/octahedral.h"
#include "foliage/prepare.h"
#include "tests/foliage/hand_cells.h"
#include "tests/support/data.h"

namespace manzana::foliage {
namespace {

std::uint8_t share(const PreparedPlant& plant, std::uint32_t cell, const Vec3d& direction) {
  const std::uint32_t side = plant.visibility.side;
  for (std::uint32_t d = 0; d < side * side; ++d)
    if (glm::distance(grid_direction(side, d % side, d / side), direction) < 1e-9)
      return plant.visibility.share[cell * side * side + d];
  FAIL("no such direction");
  return 0;
}

/// The same rays, each against every triangle, in double.
CellPixels cast(const PreparedPlant& plant, const Vec3d& to_eye, int pixels) {
  Vec3d low(1e300), high(-1e300);
  for (const auto* part : {&plant.bark, &plant.leaves})
    for (const PlantQuad& quad : *part)
      for (const auto& c : quad.corners)
        low = glm::min(low, Vec3d(c.position)), high = glm::max(high, Vec3d(c.position));
  const Vec3d centre = 0.5 * (low + high), right = glm::normalize(glm::cross(Vec3d(0, 0, 1), to_eye)),
              up = glm::cross(to_eye, right);
  const double radius = 0.5 * glm::length(high - low);
  const Image& image = plant.leaf_image;
  const auto hit = [&](const PlantQuad& quad, const Vec3d& origin, bool leaf) {
    double best = -1e300;
    for (const std::size_t k : {1U, 2U}) {
      const auto &a = quad.corners[0], &b = quad.corners[k], &c = quad.corners[k + 1];
      const Vec3d e = Vec3d(b.position) - Vec3d(a.position), f = Vec3d(c.position) - Vec3d(a.position);
      const Vec3d n = glm::cross(to_eye, f);
      const double det = glm::dot(e, n);
      if (std::abs(det) < 1e-14) continue;
      const Vec3d s = origin - Vec3d(a.position), q = glm::cross(s, e);
      const double v = glm::dot(s, n) / det, w = glm::dot(to_eye, q) / det, t = glm::dot(f, q) / det;
      if (v < 0 || w < 0 || v + w > 1) continue;
      const auto texel = [&](double a0, double b0, double c0) {
        const double at = (a0 + (b0 - a0) * v + (c0 - a0) * w) * 8 / 65535;
        return static_cast<std::size_t>((at - std::floor(at)) * image.size);
      };
      if (leaf &&
          image.rgba[4 * (texel(a.v, b.v, c.v) * static_cast<std::size_t>(image.size) + texel(a.u, b.u, c.u)) + 3] <
              128)
        continue;
      best = std::max(best, t);
    }
    return best;
  };
  CellPixels count{std::vector<std::uint32_t>(plant.cells.size()), std::vector<std::uint32_t>(plant.cells.size()), {}};
  for (int y = 0; y < pixels; ++y)
    for (int x = 0; x < pixels; ++x) {
      const double step = 2 * radius / pixels;
      const Vec3d origin = centre + right * ((x + 0.5) * step - radius) + up * ((y + 0.5) * step - radius);
      double best = -1e300;
      std::size_t who = plant.cells.size();
      for (std::uint32_t q = plant.branch_levels[0].quads.first; q < plant.branch_levels[0].quads.last; ++q)
        best = std::max(best, hit(plant.bark[q], origin, false));
      for (std::size_t c = 0; c < plant.cells.size(); ++c) {
        double own = -1e300;
        for (std::uint32_t q = plant.cells[c].quads.first; q < plant.cells[c].quads.last; ++q)
          own = std::max(own, hit(plant.leaves[q], origin, true));
        if (own > -1e300) ++count.own[c];
        if (own > best) best = own, who = c;
      }
      if (who < plant.cells.size()) ++count.seen[who];
    }
  return count;
}

}  // namespace

TEST_CASE("a cell behind another is hidden from one side only") {
  PreparedPlant plant;
  add_cell(plant, {square(0, 1)});
  add_cell(plant, {square(1, 2)});
  add_cell(plant, {});
  bake_visibility(plant, {.side = 3});
  CHECK(share(plant, 0, {1, 0, 0}) == 0);
  CHECK(share(plant, 0, {-1, 0, 0}) == 255);
  CHECK(share(plant, 1, {1, 0, 0}) == 255);
  CHECK(static_cast<double>(share(plant, 1, {-1, 0, 0})) == Approx(255 * 0.75).margin(2));
  // Edge-on there is no pixel, and the cell stays; an empty one has nothing to show.
  CHECK(share(plant, 0, {0, 0, 1}) == 255);
  for (std::uint32_t d = 0; d < 9; ++d) CHECK(plant.visibility.share[2 * 9 + d] == 0);
}

TEST_CASE("trunk and branches hide leaves too") {
  PreparedPlant plant;
  add_cell(plant, {square(0, 1)});
  plant.bark = {square(1, 2), square(-1, 2)};
  plant.branch_levels.resize(2);
  plant.branch_levels[0].quads = {0, 1};
  plant.branch_levels[1].quads = {1, 2};  // a coarser level: not there when the finest is
  bake_visibility(plant, {.side = 3});
  CHECK(share(plant, 0, {1, 0, 0}) == 0);
  CHECK(share(plant, 0, {-1, 0, 0}) == 255);
}

TEST_CASE("shares of what is seen are rounded but never to nothing") {
  CHECK(seen_share(0, 0, true) == 0);
  CHECK(seen_share(0, 0, false) == 255);
  CHECK(seen_share(0, 5, false) == 0);
  CHECK(seen_share(1, 100'000, false) == 1);
  CHECK(seen_share(99'999, 100'000, false) == 255);
  CHECK(seen_share(1, 2, false) == 128);
  CHECK(seen_share(~0U, ~0U, false) == 255);
}

TEST_CASE("cells are seen as rays see them") {
  PrepareOptions options;
  options.quads_per_cell = 16;
  const PreparedPlant plant = prepare(grow_plant(builtin_species("shrub"), 3), options);
  REQUIRE(plant.cells.size() > 3);
  for (const Vec3d& to_eye : {glm::normalize(Vec3d(1, .2, .1)), glm::normalize(Vec3d(-.3, .7, .6))}) {
    constexpr int kPixels = 64;
    const CellPixels ours = CellCounter(plant)(view_of(plant, to_eye, kPixels)), rays = cast(plant, to_eye, kPixels);
    const CellPixels behind = cast(plant, -to_eye, kPixels);
    const auto off = [](std::uint32_t a, std::uint32_t b) { return a > b ? a - b : b - a; };
    std::uint32_t own = 0, off_in_front = 0, off_behind = 0;
    for (std::size_t c = 0; c < plant.cells.size(); ++c) {
      own += rays.own[c];
      off_in_front += off(rays.own[c], ours.own[c]) + off(rays.seen[c], ours.seen[c]);
      off_behind += off(behind.own[c], ours.own[c]) + off(behind.seen[c], ours.seen_from_behind[c]);
    }
    const std::uint32_t rounding = 4 + own / 200;  // pixel centres on an edge of a triangle or texel
    CHECK(own > 200);
    CHECK(off_in_front <= rounding);
    CHECK(off_behind <= rounding);
  }
}

TEST_CASE("both vertices of a pair see the same") {
  PreparedPlant plant = prepare(grow_plant(builtin_species("shrub"), 3));
  for (const std::uint32_t side : {2U, 5U, 6U}) {
    bake_visibility(plant, {.side = side, .pixels = 64});
    check(plant);
    bool same = true;
    for (std::uint32_t d = 0; d < side * side; ++d)
      for (std::uint32_t e = 0; e < side * side; ++e)
        if (glm::distance(grid_direction(side, d % side, d / side), grid_direction(side, e % side, e / side)) < 1e-9)
          same = same && plant.visibility.share[d] == plant.visibility.share[e];
    CHECK(same);
  }
  CHECK_THROWS_AS(bake_visibility(plant, {.side = 1}), std::invalid_argument);
  CHECK_THROWS_AS(bake_visibility(plant, {.side = 9, .pixels = -1}), std::invalid_argument);
}

TEST_CASE("each direction has what an eye there sees") {
  constexpr int kPixels = 200;
  PreparedPlant plant = prepare(grow_plant(builtin_species("shrub"), 3), {.quads_per_cell = 100, .visibility_side = 0});
  REQUIRE(plant.cells.size() > 3);
  const CellCounter counter(plant);
  for (const std::uint32_t side : {2U, 4U, 5U}) {
    bake_visibility(plant, {.side = side, .pixels = kPixels});
    for (std::uint32_t d = 0; d < side * side; ++d) {
      const CellPixels count = counter(view_of(plant, grid_direction(side, d % side, d / side), kPixels));
      for (std::uint32_t c = 0; c < plant.cells.size(); ++c) {
        const double expected = 255.0 * count.seen[c] / std::max(count.own[c], 1U);
        CAPTURE(side, d, c, count.own[c]);
        // A picture from behind rounds some pixels' centres to the other side of an edge.
        CHECK(std::abs(plant.visibility.share[c * side * side + d] - expected) <= 3);
      }
    }
  }
}

TEST_CASE("a cell of a few pixels is looked at nearer") {
  PreparedPlant plant;
  add_cell(plant, {square(0, 10)});
  add_cell(plant, {square(1, 0.02F, 3)});
  add_cell(plant, {square(2, 0.02F, 3 + 0.02F)});  // hides the half of it
  add_cell(plant, {square(1, 0.02F, -3)});
  bake_visibility(plant, {.side = 3});
  CHECK(static_cast<double>(share(plant, 1, {1, 0, 0})) == Approx(255 * 0.5).margin(255 * 0.048));
  CHECK(share(plant, 2, {1, 0, 0}) == 255);
  CHECK(share(plant, 3, {1, 0, 0}) == 255);
  for (const std::uint32_t cell : {1U, 2U, 3U}) CHECK(share(plant, cell, {-1, 0, 0}) == 0);
}

TEST_CASE("shares are within three standard errors of those of a finer picture") {
  const auto folder = data_file("trees");
  if (!folder) return;
  for (const char* name : {"aspen_medium_modelled.glb", "ash_medium.glb"}) {
    const PreparedPlant plant = prepare(read_plant(*folder / name), {.visibility_side = 0});
    const CellCounter counter(plant);
    const Vec3d to_eye = glm::normalize(Vec3d(0.3, -1, 0.4));
    const ParallelView view = view_of(plant, to_eye, picture_size(plant, counter));
    const CellPixels ours = enough_pixels(plant, view, counter), fine = counter(view_of(plant, to_eye, 4096));
    std::size_t few = 0;
    for (std::size_t c = 0; c < plant.cells.size(); ++c) {
      few += ours.own[c] < kEnoughPixels ? 1 : 0;
      const auto part = [&](const CellPixels& count) { return static_cast<double>(count.seen[c]) / count.own[c]; };
      const double pixels = std::min(ours.own[c], fine.own[c]);
      CAPTURE(name, c, ours.own[c], fine.own[c]);
      CHECK(std::abs(part(ours) - part(fine)) <= 3 * 0.5 / std::sqrt(pixels));
    }
    CHECK(few == 0);
  }
}

TEST_CASE("progress of visibility rises to one") {
  PreparedPlant plant = prepare(grow_plant(builtin_species("shrub"), 3), {.visibility_side = 0});
  std::vector<double> told;
  bake_visibility(plant, {.side = 5, .progress = [&](double done) { told.push_back(done); }});
  CHECK(told.size() > 10);
  CHECK(std::is_sorted(told.begin(), told.end()));
  CHECK(told.back() == 1);
}

// The figures of the report: run by their name.
TEST_CASE("figures of visibility", "[.figures]") {
  for (const char* name : {"ash_medium", "aspen_medium_modelled", "oak_dense", "oak_medium", "pine_medium"}) {
    const auto file = data_file("trees/" + std::string(name) + ".glb");
    if (!file) return;
    const Plant source = read_plant(*file);
    const auto seconds = [](auto since) {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - since).count();
    };
    const auto start = std::chrono::steady_clock::now();
    PreparedPlant plant = prepare(source);
    const double prepared = seconds(start);
    const auto baking = std::chrono::steady_clock::now();
    bake_visibility(plant);
    const double baked = seconds(baking);
    const std::vector<std::uint8_t> coarse = plant.visibility.share;
    double mean = 0, worst = 0;
    bake_visibility(plant, {.pixels = 2048});
    for (std::size_t i = 0; i < coarse.size(); ++i) {
      mean += coarse[i] / 255.0 / static_cast<double>(coarse.size());
      worst = std::max(worst, std::abs(coarse[i] - plant.visibility.share[i]) / 255.0);
    }
    std::printf("%s: %zu cells, prepared %.2f s, visibility %.2f s, mean %.3f, against 2048 pixels at most %.3f off\n",
                name, plant.cells.size(), prepared, baked, mean, worst);
  }
}

}  // namespace manzana::foliage

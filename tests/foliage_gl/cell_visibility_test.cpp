// What is seen of cells: by the CPU, by pictures of ids, by occlusion queries.
#include "foliage/gl/cell_visibility.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "foliage/generate.h"
#include "foliage/import/gltf_plant.h"
#include "foliage/import/species.h"
#include "foliage/octahedral.h"
#include "foliage/prepare.h"
#include "gl/context.h"
#include "gl/error_log.h"
#include "tests/foliage/hand_cells.h"
#include "tests/support/data.h"

namespace manzana::foliage {
namespace {

double part(const CellPixels& count, std::size_t cell) {
  return count.own[cell] == 0 ? 1 : static_cast<double>(count.seen[cell]) / count.own[cell];
}

/// Three standard errors of a share of so many pixels [numerics: 0.016 each at 1000].
double bound(std::uint32_t pixels) { return 3 * 0.5 / std::sqrt(static_cast<double>(std::max(pixels, 1U))); }

/// The worst difference in units of that bound, over all cells.
double difference(const CellPixels& a, const CellPixels& b) {
  double worst = 0;
  for (std::size_t c = 0; c < a.own.size(); ++c)
    worst = std::max(worst, std::abs(part(a, c) - part(b, c)) / bound(std::min(a.own[c], b.own[c])));
  return worst;
}

void check_agreement(const PreparedPlant& plant, std::initializer_list<Vec3d> directions) {
  gl::ErrorLog log;
  const CellCounter cpu(plant);
  CellCounterGl ids(plant, CountBy::ids), queries(plant, CountBy::queries);
  const int pixels = picture_size(plant, cpu);
  for (const Vec3d& to_eye : directions) {
    const ParallelView view = view_of(plant, to_eye, pixels);
    const CellPixels expected = enough_pixels(plant, view, cpu), by_ids = enough_pixels(plant, view, std::ref(ids)),
                     by_queries = enough_pixels(plant, view, std::ref(queries));
    CAPTURE(plant.name, plant.cells.size(), pixels, to_eye.x);
    CHECK(difference(expected, by_ids) <= 1);
    CHECK(difference(expected, by_queries) <= 1);
    CHECK(difference(by_ids, by_queries) <= 1);
  }
  CHECK(log.messages().empty());
}

std::vector<std::vector<std::uint8_t>> shares_by_all(PreparedPlant plant, std::uint32_t side) {
  std::vector<std::vector<std::uint8_t>> shares;
  bake_visibility(plant, {.side = side});
  shares.push_back(plant.visibility.share);
  for (const CountBy by : {CountBy::ids, CountBy::queries}) {
    CellCounterGl counter(plant, by);
    bake_visibility(plant, {.side = side}, std::ref(counter));
    shares.push_back(plant.visibility.share);
  }
  return shares;
}

}  // namespace

TEST_CASE("species are seen alike by the CPU and both ways of the GPU") {
  const gl::HeadlessContext context;
  for (const char* name : {"shrub", "broadleaf", "conifer"})
    check_agreement(prepare(grow_plant(builtin_species(name), 3), {.quads_per_cell = 32, .visibility_side = 0}),
                    {glm::normalize(Vec3d(1, 0.2, 0.1)), Vec3d(0, 0, 1), glm::normalize(Vec3d(-1, -1, -1))});
}

TEST_CASE("models are seen alike by the CPU and both ways of the GPU") {
  const auto folder = data_file("trees");
  if (!folder) return;
  const gl::HeadlessContext context;
  for (const char* name : {"ash_medium.glb", "pine_medium.glb", "oak_medium.glb"})
    check_agreement(prepare(read_plant(*folder / name), {.visibility_side = 0}), {glm::normalize(Vec3d(-1, 0.5, 0.3))});
}

TEST_CASE("a modelled crown is seen alike by the CPU and both ways of the GPU") {
  const auto file = data_file("trees/aspen_medium_modelled.glb");
  if (!file) return;
  const gl::HeadlessContext context;
  const PreparedPlant plant = prepare(read_plant(*file), {.visibility_side = 0});
  const ParallelView view = view_of(plant, glm::normalize(Vec3d(1, 1, 0.2)), 1024);
  const CellPixels expected = CellCounter(plant)(view);
  CHECK(difference(expected, CellCounterGl(plant, CountBy::ids)(view)) <= 1);
  CHECK(difference(expected, CellCounterGl(plant, CountBy::queries)(view)) <= 1);
}

TEST_CASE("a cell behind another and cells without a pixel are the same to all") {
  const gl::HeadlessContext context;
  PreparedPlant plant;
  add_cell(plant, {square(0, 1)});
  add_cell(plant, {square(1, 2)});
  add_cell(plant, {});
  plant.bark = {square(-1, 1.5F)};
  const auto shares = shares_by_all(plant, 3);
  for (std::size_t i = 0; i < shares[0].size(); ++i)
    for (const std::size_t by : {1U, 2U}) {
      CAPTURE(i, by);
      CHECK(std::abs(shares[by][i] - shares[0][i]) <= 255 * bound(kEnoughPixels));
    }
  for (const auto& share : shares) {
    CHECK(std::count(share.begin(), share.begin() + 9, 0) >= 2);    // in front and behind
    CHECK(std::count(share.begin(), share.begin() + 9, 255) >= 1);  // no pixel from above: it is kept
    CHECK(std::count(share.begin() + 18, share.end(), 0) == 9);     // no leaf
  }
}

TEST_CASE("a plant of one leaf is all seen from everywhere") {
  const gl::HeadlessContext context;
  PreparedPlant plant;
  add_cell(plant, {square(0, 0.03F)});
  for (const auto& share : shares_by_all(plant, 5))
    CHECK(std::count(share.begin(), share.end(), 255) == static_cast<std::ptrdiff_t>(share.size()));
}

TEST_CASE("cells in one plane do not hide each other") {
  const gl::HeadlessContext context;
  PreparedPlant plant;
  for (const float y : {-3.0F, -1.0F, 1.0F, 3.0F}) add_cell(plant, {square(0, 1, y), square(0, 1, y, 2)});
  for (const auto& share : shares_by_all(plant, 5))
    for (const std::uint8_t s : share) CHECK(s >= 255 * (1 - bound(kEnoughPixels)));
}

TEST_CASE("of cells in the same place the latter is seen by ids and both by queries") {
  const gl::HeadlessContext context;
  PreparedPlant plant;
  add_cell(plant, {square(0, 1)});
  add_cell(plant, {square(0, 1)});
  const ParallelView view = view_of(plant, {1, 0, 0}, 64);
  for (const CellPixels& count : {CellCounter(plant)(view), CellCounterGl(plant, CountBy::ids)(view)}) {
    CHECK(count.seen[0] == 0);
    CHECK(count.seen[1] == count.own[1]);
    CHECK(count.own[0] == count.own[1]);
  }
  const CellPixels both = CellCounterGl(plant, CountBy::queries)(view);
  CHECK(both.seen == both.own);
}

}  // namespace manzana::foliage

// Meshes on demand: places in buffers against a table of what is taken; what is held against all of it.
#include "scenegraph/draw/city_meshes.h"

#include <catch2/catch.hpp>

#include "gl/context.h"
#include "tests/draw/hand_scene.h"
#include "tests/draw/picture.h"
#include "tests/support/random.h"

namespace manzana::draw {
namespace {

constexpr Size kSize{160, 90};

/// A street of blocks to the east, each with twelve houses of its own colour and ground.
Scene street(int blocks) {
  std::vector<HandBlock> all;
  for (int b = 0; b < blocks; ++b) {
    HandBlock block;
    const float x = 100.0F * static_cast<float>(b);
    for (int h = 0; h < 200; ++h)
      block.buildings.push_back(make_box({x + 4.0F * static_cast<float>(h % 20), 4.0F * static_cast<float>(h / 20), 0},
                                         {3, 3, 6}, 0x302010U * static_cast<std::uint32_t>(b + 1), Material::concrete));
    block.surfaces.push_back(make_level({x + 40, 20, 0}, {100, 60}, 0x408040, Material::grass));
    all.push_back(std::move(block));
  }
  return make_scene(all);
}

culling::View seen_from(double x) { return culling::look({x, -60, 30}, {0, 1, -0.3}, {0, 0, 1}, 0.8, 16.0 / 9); }

std::uint64_t triangles(const MeshLayer& layer, std::span<const culling::ObjectRun> runs) {
  std::uint64_t sum = 0;
  for (const culling::ObjectRun& run : runs) {
    const culling::ObjectRun rows = layer.table.rows(run);
    sum += (layer.index_first[rows.last] - layer.index_first[rows.first]) / 3;
  }
  return sum;
}

}  // namespace

TEST_CASE("ranges: what is taken lies apart and inside and what is given back joins again") {
  support::Random random(20);
  gl::Ranges ranges;
  std::vector<bool> taken;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> held;
  for (int step = 0; step < 20'000; ++step) {
    const auto n = static_cast<std::uint32_t>(1 + random.below(40));
    if (random.below(100) == 0 && taken.size() < 3000) {
      ranges.grow(ranges.size() + n);
      taken.resize(ranges.size());
    } else if (random.below(2) == 0) {
      const auto first = ranges.take(n);
      std::uint32_t longest = 0, free = 0;
      for (const bool t : taken) longest = std::max(longest, free = t ? 0 : free + 1);
      REQUIRE(first.has_value() == (longest >= n));
      for (std::uint32_t i = 0; first && i < n; ++i) {
        REQUIRE(!taken.at(*first + i));
        taken[*first + i] = true;
      }
      if (first) held.emplace_back(*first, n);
    } else if (!held.empty()) {
      std::swap(held[static_cast<std::size_t>(random.below(static_cast<int>(held.size())))], held.back());
      ranges.give(held.back().first, held.back().second);
      for (std::uint32_t i = 0; i < held.back().second; ++i) taken[held.back().first + i] = false;
      held.pop_back();
    }
    REQUIRE(ranges.taken() == static_cast<std::uint32_t>(std::ranges::count(taken, true)));
  }
}

TEST_CASE("pieces hold every row once with all vertices that it names") {
  const Scene scene = street(3);
  const auto pieces = cut_into_pieces(scene.buildings);
  REQUIRE(pieces.size() > 3);
  std::uint32_t row = 0;
  for (const Piece& piece : pieces) {
    CHECK(piece.rows.first == row);
    row = piece.rows.last;
    for (std::uint32_t i = scene.buildings.index_first[piece.rows.first];
         i < scene.buildings.index_first[piece.rows.last]; ++i) {
      CHECK(scene.buildings.mesh.indices[i] >= piece.vertices.first);
      CHECK(scene.buildings.mesh.indices[i] < piece.vertices.last);
    }
  }
  CHECK(row + 1 == scene.buildings.index_first.size());
}

TEST_CASE("commands draw what is held of the runs and what is not held waits") {
  const gl::HeadlessContext context;
  const Scene scene = street(3);
  CityMeshes meshes(scene);
  support::Random random(20);
  for (int round = 0; round < 50; ++round) {
    std::vector<culling::ObjectRun> runs;
    const auto below = [&](int n) { return static_cast<std::uint32_t>(random.below(n)); };
    for (std::uint32_t at = below(100); at + 1 < scene.tree.objects();) {
      const auto end = std::min(at + 1 + below(90), scene.tree.objects());
      runs.push_back({at, end});
      at = end + below(90);
    }
    const std::size_t left = meshes.bring(scene, runs, {}, round == 0 ? 0 : std::size_t{1} << 30);
    std::vector<gl::DrawCommand> commands(most_commands(meshes.buildings, runs.size()));
    std::uint64_t drawn = 0;
    for (std::size_t p = 0; p < kPaints; ++p)
      drawn += make_commands(scene.buildings.table, meshes.buildings, static_cast<Paint>(p), runs, commands.data())
                   .triangles;
    CHECK(drawn == (round == 0 ? 0 : triangles(scene.buildings, runs)));
    CHECK((left > 0) == (round == 0));
    const auto seen = [&](std::uint32_t piece) {
      const culling::ObjectRun& rows = meshes.buildings.pieces[piece].rows;
      return std::ranges::any_of(runs, [&](const culling::ObjectRun& run) {
        const culling::ObjectRun of_run = scene.buildings.table.rows(run);
        return of_run.first < rows.last && rows.first < of_run.last;
      });
    };
    CHECK(std::ranges::all_of(meshes.buildings.in_sight, seen));  // what a frame costs follows them
  }
  CHECK(meshes.held_bytes() <= meshes.all_bytes());
  CHECK(meshes.device_bytes() <= 1.25 * static_cast<double>(meshes.all_bytes()) + 700'000);
}

TEST_CASE("with little room the pictures along a path are the same and what was behind has left") {
  const gl::HeadlessContext context;
  const Scene scene = street(24);
  Renderer all(scene, simple_plants(), {.samples = 1}), little(scene, simple_plants(), {.samples = 1});
  little.resize(kSize);
  const std::size_t others = little.memory().sum() - little.memory().meshes;
  Renderer capped(scene, simple_plants(), {.samples = 1}, others + 2'000'000);
  std::size_t held_most = 0;
  for (double x = 0; x < 2400; x += 150) {
    const culling::View view = seen_from(x);
    const VisibleSets sets = visible(scene, view, Structure::bqr);
    const Picture expected = take_picture(all, kSize, scene, sets, view);
    const Picture found = take_picture(capped, kSize, scene, sets, view);
    CHECK(different_pixels(expected, found, 0) == 0);
    CHECK(capped.memory().meshes_missing == 0);
    held_most = std::max(held_most, capped.memory().meshes_held);
  }
  CHECK(all.memory().meshes_held > 3'000'000);
  CHECK(held_most < 2'000'000);
  CHECK(capped.memory().sum() <= others + 2'500'000);
  CHECK(all.memory().meshes_seen == all.memory().meshes_held);
}

TEST_CASE("what there is no room for at all is missing and is told") {
  const gl::HeadlessContext context;
  const Scene scene = street(6);
  Renderer renderer(scene, simple_plants(), {.samples = 1}, 1);
  const culling::View view = culling::look({250, -600, 300}, {0, 1, -0.4}, {0, 0, 1}, 0.8, 16.0 / 9);
  const VisibleSets sets = visible(scene, view, Structure::bqr);
  take_picture(renderer, kSize, scene, sets, view);
  CHECK(renderer.memory().meshes_missing > 0);
  CHECK(renderer.memory().meshes < 1'000'000);
}

TEST_CASE("in a frame no more is uploaded than is allowed and what waits comes later") {
  const gl::HeadlessContext context;
  const Scene scene = street(8);
  Renderer renderer(scene, simple_plants(), {.samples = 1});
  const culling::View view = culling::look({400, -700, 300}, {0, 1, -0.4}, {0, 0, 1}, 0.8, 16.0 / 9);
  const VisibleSets sets = visible(scene, view, Structure::bqr);
  DrawOptions options;
  options.upload_bytes = 100'000;
  renderer.resize(kSize);
  std::size_t held = 0;
  int frames = 0;
  while (renderer.draw(scene, sets, view, options).bytes_to_bring > 0) {
    REQUIRE(++frames < 1000);
    CHECK(renderer.memory().meshes_held - held <= 200'000);
    held = renderer.memory().meshes_held;
  }
  CHECK(frames > 5);
}

}  // namespace manzana::draw

// Pictures whose content is known: what stands where, what hides what.
#include "scenegraph/draw/renderer.h"

#include <glad/gl.h>

#include <catch2/catch.hpp>
#include <new>

#include "foliage/wind.h"
#include "gl/context.h"
#include "gl/error_log.h"
#include "tests/draw/hand_scene.h"
#include "tests/draw/picture.h"

namespace {
thread_local std::size_t allocations = 0;  // of this thread: the driver compiles shaders on others
}

void* operator new(std::size_t bytes) {
  ++allocations;
  if (void* memory = std::malloc(bytes == 0 ? 1 : bytes)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(bytes == 0 ? 1 : bytes);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace manzana::draw {
namespace {

constexpr Size kSize{320, 240};
constexpr double kAspect = 4.0 / 3.0;
constexpr std::uint32_t kRed = 0xc01010, kGrass = 0x5c8a3a;

struct Stage {
  gl::HeadlessContext context;
  gl::ErrorLog errors;
  ~Stage() { CHECK(errors.messages() == std::vector<std::string>{}); }
};

Quality low() { return {.name = "low", .samples = 1, .tree_error_px = 2}; }

// A red tower of 20 x 20 x 60 m, 150 m to the north; a tree 40 m off; grass round both.
HandBlock tower_block(Material material = Material::concrete) {
  HandBlock block;
  block.buildings = {make_box({0, 150, 0}, {20, 20, 60}, kRed, material)};
  block.surfaces = {make_level({0, 200, 0.1F}, {800, 800}, kGrass, Material::grass)};
  TreeInstance tree;
  tree.position = {15, 40, 0};
  tree.height_m = 12;
  tree.crown_radius_m = 4;
  block.trees = {tree};
  return block;
}

culling::View street_view(const Scene& scene) {
  return look_in(scene.blocks[0], {0, 0, 1.7}, {0, 1, 0.12}, 60, kAspect);
}

// A wall to the north, and what else belongs to its building, far from it.
HandMesh wall_with_wing(std::uint32_t rgb, const Vec2& wing) {
  HandMesh mesh;
  add_quad(mesh, {-20, 100, 0}, {20, 100, 0}, {20, 100, 30}, {-20, 100, 30}, rgb, Material::concrete);
  add_quad(mesh, {wing.x, wing.y, 0}, {wing.x + 5, wing.y, 0}, {wing.x + 5, wing.y, 5}, {wing.x, wing.y, 5}, rgb,
           Material::concrete);
  return mesh;
}

// Whether (x, y) is inside of the polygon of the projected corners, grown by `margin` pixels.
bool within(const Vec2d& low, const Vec2d& high, const Vec2d& p, double margin) {
  return p.x > low.x - margin && p.x < high.x + margin && p.y > low.y - margin && p.y < high.y + margin;
}

}  // namespace

TEST_CASE("a tower stands where it must, sky above, grass below") {
  const Stage stage;
  HandBlock block = tower_block();
  block.trees.clear();
  const Scene scene = make_scene({block});
  const culling::View view = street_view(scene);
  Renderer renderer(scene, simple_plants(), low());
  const Picture picture = take_picture(renderer, kSize, scene, visible(scene, view, Structure::bqr), view);

  // The wall towards the eye is the outline: its top corners, and its foot.
  const Vec2d top_left = project(view, kSize, scene.blocks[0].to_local({-10, 140, 60}));
  const Vec2d foot_right = project(view, kSize, scene.blocks[0].to_local({10, 140, 0.1}));
  int wrong = 0, tower = 0;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const Vec2d p(x + 0.5, y + 0.5);
      // Perspective with a tilted camera: the wall is a trapezium, so a margin of some pixels is left out.
      const bool inside = within(top_left, foot_right, p, -4), outside = !within(top_left, foot_right, p, 4);
      tower += inside ? 1 : 0;
      if (inside) wrong += reddish(picture.at(x, y)) ? 0 : 1;
      if (outside) wrong += reddish(picture.at(x, y)) ? 1 : 0;
    }
  }
  CHECK(tower > 1000);
  CHECK(wrong == 0);
  CHECK(bluish(picture.at(20, 10)));
  CHECK(greenish(picture.at(20, 235)));
  CHECK(greenish(picture.at(300, 235)));
}

TEST_CASE("there is ground below the horizon without any surface, and sky when looking up") {
  const Stage stage;
  HandBlock block;
  block.buildings = {make_box({0, 150, 0}, {20, 20, 60}, kRed, Material::concrete)};
  const Scene scene = make_scene({block});
  Renderer renderer(scene, simple_plants(), low());
  for (const double height : {0.05, 1.7, 300.0, 30000.0}) {
    INFO(height);
    culling::View view = look_in(scene.blocks[0], {0, 0, height}, {0, -1, 0}, 60, kAspect);
    Picture picture = take_picture(renderer, kSize, scene, visible(scene, view, Structure::bqr), view);
    CHECK(bluish(picture.at(160, 5)));
    view = look_in(scene.blocks[0], {0, 0, height}, {0, -0.3, -1}, 60, kAspect);
    DrawOptions no_fog;
    no_fog.layers.fog = false;
    picture = take_picture(renderer, kSize, scene, visible(scene, view, Structure::bqr), view, no_fog);
    int sky = 0;
    for (int y = 0; y < kSize.height; ++y) {
      for (int x = 0; x < kSize.width; ++x) sky += bluish(picture.at(x, y)) ? 1 : 0;
    }
    CHECK(sky == 0);
  }
}

TEST_CASE("a tree is green where its crown is") {
  const Stage stage;
  const Scene scene = make_scene({tower_block()});
  const culling::View view = street_view(scene);
  for (const char* quality : {"fast", "balanced", "accurate", "exact"}) {
    INFO(quality);
    Renderer renderer(scene, simple_plants(), quality_named(quality));
    DrawOptions options;
    options.layers.surfaces = false;
    const Picture picture = take_picture(renderer, kSize, scene, visible(scene, view, Structure::bqr), view, options);
    const Vec2d crown = project(view, kSize, scene.blocks[0].to_local({15, 40, 7}));
    CHECK(greenish(picture.at(static_cast<int>(crown.x), static_cast<int>(crown.y))));
    const Vec2d beside = project(view, kSize, scene.blocks[0].to_local({22, 40, 9}));
    CHECK(!greenish(picture.at(static_cast<int>(beside.x), static_cast<int>(beside.y))));
  }
}

TEST_CASE("cars are drawn where they are, in every level") {
  const Stage stage;
  HandBlock block;
  block.surfaces = {make_level({0, 100, 0.1F}, {400, 400}, 0x5a5a5c, Material::junction)};
  const Scene scene = make_scene({block});
  Renderer renderer(scene, simple_plants(), low());
  for (const double distance : {8.0, 25.0, 60.0, 150.0}) {
    INFO(distance);
    const culling::View view = look_in(scene.blocks[0], {0, 0, 1.5}, {0, 1, 0}, 20, kAspect);
    VisibleSets sets = visible(scene, view, Structure::bqr);
    const Picture empty = take_picture(renderer, kSize, scene, sets, view);
    CarState car;
    car.position = scene.blocks[0].to_local({0.5, distance, 0.1});
    car.forward = scene.blocks[0].axes[0];
    sets.cars = {car};
    const Picture picture = take_picture(renderer, kSize, scene, sets, view);
    const Vec2d low_corner = project(view, kSize, scene.blocks[0].to_local({0.5 - 2.6, distance - 1.2, 0.05}));
    const Vec2d high_corner = project(view, kSize, scene.blocks[0].to_local({0.5 + 2.6, distance - 0.95, 2.0}));
    int inside = 0, outside = 0;
    for (int y = 0; y < kSize.height; ++y) {
      for (int x = 0; x < kSize.width; ++x) {
        if (picture.at(x, y) == empty.at(x, y)) continue;
        const bool in = x > low_corner.x - 2 && x < high_corner.x + 2 && y > high_corner.y - 2 && y < low_corner.y + 2;
        ++(in ? inside : outside);
      }
    }
    const double box = (high_corner.x - low_corner.x) * (low_corner.y - high_corner.y);
    CHECK(inside > 0.25 * box);
    CHECK(outside == 0);
  }
}

TEST_CASE("two renders are equal to the bit, and neither culling nor drawing allocates") {
  const Stage stage;
  const Scene scene = make_scene({tower_block(Material::wall)});
  const culling::View view = street_view(scene);
  VisibleSets sets = visible(scene, view, Structure::bqr);
  CarState car;
  car.position = scene.blocks[0].to_local({-5, 20, 0.1});
  sets.cars = {car, car};
  Renderer renderer(scene, simple_plants(), low());
  const Picture first = take_picture(renderer, kSize, scene, sets, view);
  const Picture second = take_picture(renderer, kSize, scene, sets, view);
  CHECK(different_pixels(first, second, 0) == 0);
  Renderer other(scene, simple_plants(), low());
  CHECK(different_pixels(first, take_picture(other, kSize, scene, sets, view), 0) == 0);

  const DrawOptions options;
  constexpr int kWarm = 20;  // the driver compiles variants of the shaders in the first frames
  for (int i = 0; i < kWarm; ++i) renderer.draw(scene, sets, view, options);
  const std::size_t before = allocations;
  for (int i = 0; i < 10; ++i) {
    find_visible(scene, view, i % 2 == 0 ? Structure::bqr : Structure::none, sets);
    find_cars(scene, 0, sets);
    renderer.draw(scene, sets, view, options);
  }
  CHECK(allocations == before);
}

TEST_CASE("counts say what was submitted") {
  const Stage stage;
  const Scene scene = make_scene({tower_block()});
  const culling::View view = street_view(scene);
  Renderer renderer(scene, simple_plants(), low());
  renderer.resize(kSize);
  const FrameCounts all = renderer.draw(scene, visible(scene, view, Structure::none), view, {});
  CHECK(all.buildings == 1);
  CHECK(all.surfaces == 1);
  CHECK(all.trees == 1);
  CHECK(all.commands == 6);            // trees: quads, lines and points, whatever is in them; and their shadows
  CHECK(all.triangles == 10 + 2 + 2);  // without the tree's
  glFinish();
  CHECK(renderer.trees_shown().leaves == 24);
  DrawOptions bare;
  bare.layers = {.buildings = false, .surfaces = false, .trees = false, .cars = false, .sky = false, .fog = false};
  CHECK(renderer.draw(scene, visible(scene, view, Structure::none), view, bare).triangles == 0);
}

TEST_CASE("with and without the structure the picture is the same") {
  const Stage stage;
  std::vector<HandBlock> blocks;
  for (int i = 0; i < 25; ++i) {
    HandBlock block = tower_block(Material::wall);
    block.plan = {(i % 5 - 2) * 300.0, (i / 5 - 2) * 300.0};
    blocks.push_back(block);
  }
  const Scene scene = make_scene(blocks);
  Renderer renderer(scene, simple_plants(), low());
  for (const double angle : {0.3, 2.0, 4.4}) {
    const culling::View view =
        culling::look({0, 0, 20}, {glm::cos(angle), glm::sin(angle), -0.1}, {0, 0, 1}, glm::radians(50.0), kAspect);
    const VisibleSets bqr = visible(scene, view, Structure::bqr), none = visible(scene, view, Structure::none);
    CHECK(count(scene.buildings.table, bqr.objects()) < count(scene.buildings.table, none.objects()));
    const Picture a = take_picture(renderer, kSize, scene, bqr, view);
    const Picture b = take_picture(renderer, kSize, scene, none, view);
    CHECK(different_pixels(a, b, 0) == 0);
    DrawOptions by_node;
    by_node.trees_by_node = true;
    CHECK(different_pixels(a, take_picture(renderer, kSize, scene, bqr, view, by_node), 0) == 0);
  }
}

TEST_CASE("the wind moves a tree and keeps it within the room that its bounds leave") {
  const Stage stage;
  HandBlock block;
  TreeInstance tree;
  tree.position = {0, 40, 0};
  tree.height_m = 12;
  tree.crown_radius_m = 4;
  block.trees = {tree};
  const Scene scene = make_scene({block});
  Renderer renderer(scene, simple_plants(), low());
  const culling::View view = look_in(scene.blocks[0], {0, 0, 6}, {0, 1, 0}, 40, kAspect);
  const VisibleSets sets = visible(scene, view, Structure::none);
  DrawOptions options;
  options.layers = {.buildings = false, .surfaces = false, .trees = true, .cars = false, .sky = false, .fog = false};
  const Picture still = take_picture(renderer, kSize, scene, sets, view, options);
  options.layers.trees = false;
  const Picture nothing = take_picture(renderer, kSize, scene, sets, view, options);
  options.layers.trees = true;
  Vec2d low(1e9), high(-1e9);
  const double r = 4 + 12 * foliage::kMostSway;
  for (const Vec3d& corner : {Vec3d(-r, 40 - r, 0), Vec3d(r, 40 - r, 0), Vec3d(-r, 40 - r, 12), Vec3d(r, 40 - r, 12)}) {
    const Vec2d at = project(view, kSize, scene.blocks[0].to_local(corner));
    low = glm::min(low, at), high = glm::max(high, at);
  }
  options.wind = 1;
  std::size_t moved = 0, outside = 0;
  for (options.seconds = 0; options.seconds < 12; options.seconds += 0.61) {
    const Picture picture = take_picture(renderer, kSize, scene, sets, view, options);
    moved += different_pixels(still, picture, 0) > 0 ? 1 : 0;
    for (int y = 0; y < kSize.height; ++y)
      for (int x = 0; x < kSize.width; ++x) {
        const bool inside = x + 1 > low.x && x < high.x && y + 1 > low.y && y < high.y;
        outside += !inside && picture.at(x, y) != nothing.at(x, y) ? 1 : 0;
      }
  }
  CHECK(moved == 20);
  CHECK(outside == 0);
}

TEST_CASE("of two walls in one plane the later one is seen wherever the rest of their buildings stands") {
  const Stage stage;
  constexpr std::uint32_t kGreen = 0x10c010;
  for (const Vec2& wing : {Vec2(-300, 0), Vec2(300, 0), Vec2(0, -300), Vec2(0, 300)}) {
    HandBlock block;
    block.buildings = {wall_with_wing(kGreen, wing), wall_with_wing(kRed, -wing)};
    const Scene scene = make_scene({block});
    const culling::View view = look_in(scene.blocks[0], {0, 0, 15}, {0, 1, 0}, 60, kAspect);
    Renderer renderer(scene, simple_plants(), low());
    const Picture picture = take_picture(renderer, kSize, scene, visible(scene, view, Structure::bqr), view);
    CHECK(reddish(picture.at(kSize.width / 2, kSize.height / 2)));
  }
}

TEST_CASE("the frozen view is drawn as lines, only when asked for") {
  const Stage stage;
  const Scene scene = make_scene({tower_block()});
  const culling::View view = look_in(scene.blocks[0], {-200, -200, 150}, {1, 1, -0.4}, 60, kAspect);
  const culling::View frozen = street_view(scene);
  Renderer renderer(scene, simple_plants(), low());
  const VisibleSets sets = visible(scene, view, Structure::bqr);
  const Picture plain = take_picture(renderer, kSize, scene, sets, view);
  DrawOptions options;
  options.frozen = &frozen;
  const Picture lines = take_picture(renderer, kSize, scene, sets, view, options);
  CHECK(different_pixels(plain, lines, 20) > 100);
}

TEST_CASE("a scene of nothing, and any size, can be drawn") {
  const Stage stage;
  const Scene scene = make_scene({});
  Renderer renderer(scene, simple_plants(), low());
  const culling::View view = culling::look({0, 0, 2}, {0, 1, 0}, {0, 0, 1}, 1, 1);
  for (const Size size : {Size{1, 1}, Size{7, 3}, Size{64, 64}}) {
    const Picture picture = take_picture(renderer, size, scene, visible(scene, view, Structure::none), view);
    CHECK(picture.rgb.size() == 3 * static_cast<std::size_t>(size.width * size.height));
  }
}

}  // namespace manzana::draw

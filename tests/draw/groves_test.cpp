// Blocks of trees that turn into one cloud of points as they become very small.
#include "scenegraph/draw/groves.h"

#include <glad/gl.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "foliage/far_pack.h"
#include "foliage/generate.h"
#include "foliage/import/load_plant.h"
#include "foliage/import/species.h"
#include "foliage/leaf_image.h"
#include "foliage/random.h"
#include "gl/context.h"
#include "gl/error_log.h"
#include "scenegraph/draw/far_trees.h"
#include "scenegraph/tree_sites.h"
#include "tests/draw/hand_scene.h"
#include "tests/draw/picture.h"

namespace manzana::draw {
namespace {

constexpr Size kSize{300, 240};
constexpr float kHeight = 11;
constexpr double kFovDeg = 20;

/// A wood of rows by rows trees, two species by turns.
HandBlock make_wood(int rows, float spacing, const Vec2d& plan = {0, 0}) {
  HandBlock block;
  block.plan = plan;
  for (int i = 0; i < rows * rows; ++i) {
    TreeInstance tree;
    const float half = 0.5F * static_cast<float>(rows - 1);
    tree.position = {spacing * (static_cast<float>(i % rows) - half), spacing * (static_cast<float>(i / rows) - half),
                     0};
    tree.height_m = kHeight;
    tree.crown_radius_m = 3.5F;
    tree.yaw = static_cast<float>(i);
    tree.plant = static_cast<std::uint16_t>(i % 2);
    block.trees.push_back(tree);
  }
  return block;
}

std::vector<foliage::PreparedPlant> two_plants() {
  std::vector<foliage::PreparedPlant> plants(kPlantSpecies);
  plants[0] = prepare(grow_plant(foliage::builtin_species("oak"), 3), {.visibility_side = 0});
  plants[1] = prepare(grow_plant(foliage::builtin_species("conifer"), 3), {.visibility_side = 0});
  return plants;
}

/// A meadow of tufts and herbs, and an oak here and there.
std::vector<foliage::PreparedPlant> meadow_plants() {
  std::vector<foliage::PreparedPlant> plants(kPlantSpecies);
  plants[0] = foliage::load_or_prepare({MANZANA_PLANTS "/grass.json"}, {}, {.visibility_side = 0}, {});
  plants[1] = foliage::load_or_prepare({MANZANA_PLANTS "/herb.json"}, {}, {.visibility_side = 0}, {});
  plants[2] = prepare(grow_plant(foliage::builtin_species("oak"), 3), {.visibility_side = 0});
  return plants;
}

/// As plants stand that nobody has planted: rows would hide more of each other, or less.
void scatter(HandBlock& block, float extent) {
  foliage::Random random(7);
  for (TreeInstance& tree : block.trees) {
    tree.position = {random.spread(extent / 2), random.spread(extent / 2), 0};
    tree.yaw = random.spread(3.14F);
  }
}

HandBlock make_meadow(std::span<const foliage::PreparedPlant> plants, std::initializer_list<std::uint16_t> kinds,
                      int oaks, int rows = 28) {
  constexpr float kSpacing = 0.35F;
  HandBlock block;
  const auto add = [&](std::uint16_t kind, const Vec2& at) {
    TreeInstance& plant = block.trees.emplace_back();
    plant.position = Vec3(at, 0);
    plant.height_m = plants[kind].height_m;
    plant.crown_radius_m = plants[kind].crown_radius_m;
    plant.yaw = static_cast<float>(block.trees.size());
    plant.plant = kind;
  };
  for (int i = 0; i < rows * rows; ++i)
    add(kinds.begin()[static_cast<std::size_t>(i) % kinds.size()],
        kSpacing * (Vec2(i % rows, i / rows) - 0.5F * static_cast<float>(rows - 1)));
  for (int i = 0; i < oaks; ++i) add(2, {3 * static_cast<float>(i) - 3, 3});
  return block;
}

/// So far away, in that direction, that trees of that height are about so high in the picture.
culling::View view_from(const Scene& scene, const Vec3d& towards, double height_px, double height_m = double{kHeight}) {
  const double focal = kSize.height / (2 * std::tan(kFovDeg / 2 * 3.14159265358979 / 180)),
               distance = height_m * focal / height_px;
  const Vec3d forward = -glm::normalize(towards);
  return look_in(scene.blocks[0], Vec3d(0, 0, height_m / 2) - forward * distance, forward, kFovDeg,
                 static_cast<double>(kSize.width) / kSize.height);
}

struct Seen {
  double cover = 0;  ///< pixels
  Vec3d light{0};    ///< linear, sum over them
  std::uint64_t points = 0;
  Vec3d colour() const { return light / cover; }  ///< mean of what is covered
};

struct Way {
  bool groves = true;
  foliage::Law law = foliage::Law::ours;
  int fine = 1;  ///< pixels along each side of one
};
/// With four samples a pixel all detail itself would cover some per cent too much.
constexpr Way kReference{false, foliage::Law::full, 4};

/// Trees alone, before black.
Seen look(Renderer& renderer, const Scene& scene, const culling::View& view, const Way& way) {
  DrawOptions options;
  options.groves = way.groves;
  options.tree_law = way.law;
  options.tree_error_px = 1;
  options.layers = {.buildings = false, .surfaces = false, .trees = true, .cars = false, .sky = false, .fog = false};
  options.transparent = true;
  const VisibleSets sets = visible(scene, view, Structure::bqr);
  const Size size{kSize.width * way.fine, kSize.height * way.fine};
  renderer.resize(size);
  Seen seen;
  seen.points = renderer.draw(scene, sets, view, options).points;
  const std::vector<unsigned char> rgb = renderer.read_pixels();
  std::vector<unsigned char> alpha(rgb.size() / 3);
  glReadPixels(0, 0, size.width, size.height, GL_ALPHA, GL_UNSIGNED_BYTE, alpha.data());
  for (const unsigned char a : alpha) seen.cover += a / 255.0;
  for (std::size_t i = 0; i < rgb.size(); ++i)
    seen.light[static_cast<int>(i % 3)] += static_cast<double>(foliage::linear_of_srgb(rgb[i]));
  seen.cover /= way.fine * way.fine, seen.light /= way.fine * way.fine;
  return seen;
}

/// Of linear colours, over the channels.
double rms(const Vec3d& a, const Vec3d& b) { return glm::length(a - b) / std::sqrt(3.0); }

void add_groves(Renderer& renderer, std::span<const foliage::PreparedPlant> plants) {
  const std::vector<GroveWanted> wanted(renderer.groves_wanted().begin(), renderer.groves_wanted().end());
  for (const GroveWanted& one : wanted) renderer.add_grove(one, make_grove(plants, *renderer.sites(), one));
}

Quality sampled(int samples) {
  Quality quality;
  quality.samples = samples;
  return quality;
}

}  // namespace

TEST_CASE("groves: cover and shine as the trees do from three directions where they take over") {
  const gl::HeadlessContext context;
  gl::ErrorLog log;
  const auto plants = two_plants();
  HandBlock wood = make_wood(9, 8);
  scatter(wood, 72);
  const Scene scene = make_scene({wood});
  Renderer renderer(scene, plants, sampled(4));
  for (const Vec3d& towards : {Vec3d(0, 0.001, 1), Vec3d(0, -1, 1), Vec3d(1, 0, 0.1)}) {
    const culling::View view = view_from(scene, towards, 0.9 * foliage::GroveOptions{}.all);
    const Seen trees = look(renderer, scene, view, kReference);
    look(renderer, scene, view, {true});
    add_groves(renderer, plants);
    const Seen grove = look(renderer, scene, view, {true});
    CAPTURE(towards.x, towards.y, towards.z, trees.cover, grove.points);
    CHECK(renderer.groves_wanted().empty());
    CHECK(grove.points > 0);
    CHECK(static_cast<double>(grove.points) < 1.5 * grove.cover);
    CHECK(grove.cover == Approx(trees.cover).epsilon(0.05));
    CHECK(rms(grove.colour(), trees.colour()) < 0.01);
  }
  CHECK(log.messages().empty());
}

TEST_CASE(
    "groves: grass, herbs and trees cover what the plants do and have their colour, from all sides and distances") {
  constexpr double kCover = 0.06, kColour = 0.01;
  const gl::HeadlessContext context;
  const auto meadow = meadow_plants(), trees = two_plants();
  struct Stand {
    const char* name;
    const std::vector<foliage::PreparedPlant>& plants;
    HandBlock block;
    float extent;
    double height;
  };
  const double grass = static_cast<double>(meadow[0].height_m), herb = static_cast<double>(meadow[1].height_m);
  for (Stand stand : {Stand{"grass", meadow, make_meadow(meadow, {0}, 0), 10, grass},
                      Stand{"herbs", meadow, make_meadow(meadow, {1}, 0), 14, herb},
                      Stand{"both", meadow, make_meadow(meadow, {0, 0, 0, 1}, 0), 10, herb},
                      Stand{"trees", trees, make_wood(14, 8), 110, double{kHeight}}}) {
    scatter(stand.block, stand.extent);
    const Scene scene = make_scene({stand.block});
    Renderer renderer(scene, stand.plants, sampled(4));
    for (const Vec3d& towards : {Vec3d(0, 0.001, 1), Vec3d(0, -1, 1), Vec3d(0, 1, 1), Vec3d(1, 0, 0.1)})
      for (const double of_all : {0.75, 0.6, 0.45}) {
        const culling::View view = view_from(scene, towards, of_all * foliage::GroveOptions{}.all, stand.height);
        const Seen full = look(renderer, scene, view, kReference);
        look(renderer, scene, view, {true});
        add_groves(renderer, stand.plants);
        const Seen grove = look(renderer, scene, view, {true});
        const Vec3d is = grove.colour(), meant = full.colour();
        CAPTURE(stand.name, towards.x, towards.y, towards.z, of_all, full.cover, is.x, is.y, is.z, meant.x, meant.y,
                meant.z);
        CHECK(grove.points > 0);
        CHECK(grove.cover == Approx(full.cover).epsilon(kCover));
        CHECK(rms(is, meant) < kColour);
      }
  }
}

TEST_CASE("groves: grass need not wait for the oaks that stand on it") {
  const gl::HeadlessContext context;
  const auto plants = meadow_plants();
  const Scene scene = make_scene({make_meadow(plants, {0}, 3)});
  Renderer renderer(scene, plants, sampled(1));
  const culling::View view = view_from(scene, {0, -1, 1}, 8, static_cast<double>(plants[0].height_m));
  look(renderer, scene, view, {true});
  add_groves(renderer, plants);
  CHECK(look(renderer, scene, view, {true}).points > 0);
}

TEST_CASE("groves: before they are there a large meadow errs little more than it is told to") {
  const gl::HeadlessContext context;
  const auto plants = meadow_plants();
  const Scene scene = make_scene({make_meadow(plants, {0}, 2, 280)});  // 78 400 tufts
  Renderer renderer(scene, plants, sampled(1));
  renderer.resize(kSize);
  const culling::View view = view_from(scene, {0.5, 0.2, 1}, 1, 1);
  const VisibleSets sets = visible(scene, view, Structure::bqr);
  std::uint32_t in_view = 0;
  for (const culling::ObjectRun& run : sets.objects()) in_view += run.last - run.first;
  REQUIRE(in_view > 70'000);
  DrawOptions options;
  options.tree_law = foliage::Law::ours;
  options.tree_error_px = 1;
  CHECK(renderer.draw(scene, sets, view, options).tree_error_px < 4);
}

TEST_CASE("groves: one that was made for afar is not shown from near, where its points would be large squares") {
  const gl::HeadlessContext context;
  const auto plants = two_plants();
  const Scene scene = make_scene({make_wood(9, 8)});
  Renderer renderer(scene, plants, sampled(1));
  const culling::View far = view_from(scene, {0, -1, 1}, 0.7), near = view_from(scene, {0, -1, 1}, 7);
  look(renderer, scene, far, {true});
  add_groves(renderer, plants);
  CHECK(look(renderer, scene, far, {true}).points > 0);
  CHECK(look(renderer, scene, near, {true}).points == look(renderer, scene, near, {false}).points);
  look(renderer, scene, near, {true});
  add_groves(renderer, plants);
  CHECK(look(renderer, scene, near, {true}).points != look(renderer, scene, near, {false}).points);
}

TEST_CASE("groves: a wood covers as much on the way to its grove as before and after") {
  const gl::HeadlessContext context;
  const auto plants = two_plants();
  const Scene scene = make_scene({make_wood(7, 9)});
  Renderer renderer(scene, plants, sampled(4));
  for (std::uint32_t p = 0; p < 2; ++p) renderer.add_pack(p, make_far_pack(plants[p]));
  std::uint64_t least = ~0ULL, most = 0;
  for (const double height : {13.0, 11.0, 10.0, 9.0, 8.0}) {
    const culling::View view = view_from(scene, {0, -1, 1}, height);
    look(renderer, scene, view, {true});
    add_groves(renderer, plants);
    const Seen with = look(renderer, scene, view, {true}), without = look(renderer, scene, view, {false});
    CAPTURE(height, with.points);
    CHECK(with.cover == Approx(without.cover).epsilon(0.06));
    least = std::min(least, with.points), most = std::max(most, with.points);
  }
  CHECK(least == 0);
  CHECK(most > 0);
}

TEST_CASE("groves: those out of sight make room and what is in sight stays") {
  const gl::HeadlessContext context;
  const auto plants = two_plants();
  const Scene scene = make_scene({make_wood(54, 4, {-1000, 0}), make_wood(54, 4, {1000, 0})});
  Renderer renderer(scene, plants, sampled(1), 8 * foliage::GroveDrawer::kPageBytes);  // room for one page
  const auto view_of = [&](std::size_t block, double back) {
    const Vec3d forward(0, 0.1, -1);
    return look_in(scene.blocks[block], -forward * back, forward, kFovDeg, 1.25);
  };
  const auto points_at = [&](std::size_t block) {
    look(renderer, scene, view_of(block, 850), {true});
    add_groves(renderer, plants);
    return look(renderer, scene, view_of(block, 850), {true}).points;
  };
  const std::uint64_t first = points_at(0), second = points_at(1);
  CHECK(first > 0);
  CHECK(second == Approx(first).epsilon(0.01));
  CHECK(renderer.memory().groves == foliage::GroveDrawer::kPageBytes);
  look(renderer, scene, view_of(0, 850), {true});
  REQUIRE(renderer.groves_wanted().size() == 1);  // it had to go
  CHECK(points_at(0) == first);
}

}  // namespace manzana::draw

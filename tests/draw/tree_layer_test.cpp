// Which law and error trees are drawn with where memory has no room for what is asked.
#include "scenegraph/draw/tree_layer.h"

#include <catch2/catch.hpp>

#include "foliage/generate.h"
#include "foliage/import/species.h"
#include "gl/context.h"
#include "gl/error_log.h"
#include "tests/draw/hand_scene.h"

namespace manzana::draw {
namespace {

std::vector<foliage::PreparedPlant> grown_plants() {
  std::vector<foliage::PreparedPlant> plants;
  for (const std::string_view name : foliage::kSpeciesNames)
    plants.push_back(prepare(grow_plant(foliage::builtin_species(name), 3), {.visibility_side = 0}));
  return plants;
}

/// Rows of trees from 8 m on.
Scene make_avenue(int trees) {
  HandBlock block;
  for (int i = 0; i < trees; ++i) {
    TreeInstance tree;
    tree.position = {i % 2 == 0 ? -6 : 6, 8 + 3 * static_cast<float>(i), 0};
    tree.height_m = 11;
    tree.crown_radius_m = 4;
    tree.plant = static_cast<std::uint16_t>(i % static_cast<int>(kPlantSpecies));
    block.trees.push_back(tree);
  }
  return make_scene({block});
}

struct Drawing {
  gl::HeadlessContext context;
  gl::ErrorLog errors;
  Scene scene = make_avenue(60);
  culling::View view = look_in(scene.blocks[0], {0, 0, 1.7}, {0, 1, 0.1}, 60, 1.5);
  VisibleSets sets = visible(scene, view, Structure::none);
  std::vector<Rows> rows{relative_to(view.eye, scene.blocks[0])};
  gl::StreamBuffer stream;

  foliage::Shown extract_with(TreeLayerGpu& layer, const TreeDetail& detail) {
    stream.begin(gl::StreamBuffer::padded(sizeof(Rows)) + stream_bytes(layer));
    const auto blocks = stream.take<Rows>(1);
    *blocks.items = rows[0];
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, foliage::kBlockRowsBinding, stream.name(), blocks.offset, sizeof(Rows));
    extract_trees(layer, scene.trees, sets.objects(), rows, detail, stream);
    stream.end();
    glFinish();
    return newest_shown(layer);
  }
  ~Drawing() { CHECK(errors.messages().empty()); }
};

constexpr double kAsked = 1.0 / 900;

}  // namespace

TEST_CASE("trees: all detail where there is room for it and whole trees of less where there is not") {
  Drawing drawing;
  const auto plants = grown_plants();
  TreeLayerGpu roomy(drawing.scene, plants, {}), narrow(drawing.scene, plants, {.quads = 40'000});
  const TreeDetail full{.law = foliage::Law::full, .error_at_1m = kAsked};
  const foliage::Shown all = drawing.extract_with(roomy, full);
  CHECK(all.missing == 0);
  CHECK(roomy.law == foliage::Law::full);
  CHECK(all.leaves > 40'000);

  const foliage::Shown less = drawing.extract_with(narrow, full);
  CHECK(less.missing == 0);
  CHECK(narrow.law == foliage::Law::ours);
  CHECK(narrow.error_at_1m >= kAsked);
  CHECK(less.leaves + less.points > 0);
  CHECK(less.bark + less.leaves <= 40'000);
}

TEST_CASE("trees: the error rises until the lists have room and falls again when they do") {
  Drawing drawing;
  const auto plants = grown_plants();
  TreeLayerGpu layer(drawing.scene, plants, {.quads = 20'000, .lines = 20'000, .points = 20'000});
  CHECK(drawing.extract_with(layer, {.error_at_1m = 0.1 * kAsked}).missing == 0);
  CHECK(layer.error_at_1m > 0.1 * kAsked);
  CHECK(drawing.extract_with(layer, {.law = foliage::Law::full}).missing == 0);
  CHECK(drawing.extract_with(layer, {.error_at_1m = 30 * kAsked}).missing == 0);
  CHECK(layer.error_at_1m == 30 * kAsked);
  CHECK(layer.law == foliage::Law::ours);
}

}  // namespace manzana::draw

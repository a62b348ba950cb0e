#include "foliage/import/classify_triangles.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "foliage/generate.h"
#include "foliage/import/assemble_plant.h"
#include "foliage/import/gltf_files.h"
#include "foliage/import/gltf_materials.h"
#include "foliage/import/gltf_plant.h"
#include "foliage/import/gltf_triangles.h"
#include "foliage/import/pieces.h"
#include "foliage/import/species.h"
#include "foliage/random.h"
#include "tests/foliage/plant_checks.h"
#include "tests/support/data.h"

using namespace manzana;
using namespace manzana::foliage;

namespace {

/// One part without names, materials and ids, its triangles in random order; and which of them are leaf.
struct Nameless {
  SourcePart part;
  std::vector<bool> leaf;
};

struct Soup {
  std::vector<std::array<Vec3d, 3>> corners;
  std::vector<std::array<Vec3, 3>> normals;
  std::vector<std::array<Vec2, 3>> uvs;
  std::vector<bool> leaf;
};

Nameless shuffled(const Soup& soup, bool uvs) {
  std::vector<std::size_t> order(soup.leaf.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(),
            [](std::size_t a, std::size_t b) { return foliage::hash(a) < foliage::hash(b); });
  Nameless out;
  for (const std::size_t t : order) {
    for (std::size_t k = 0; k < 3; ++k) {
      out.part.indices.push_back(static_cast<std::uint32_t>(out.part.positions.size()));
      out.part.positions.push_back(soup.corners[t][k]);
      out.part.normals.push_back(soup.normals[t][k]);
      out.part.uvs.push_back(uvs ? soup.uvs[t][k] : Vec2(0));
    }
    out.leaf.push_back(soup.leaf[t]);
  }
  return out;
}

Soup soup_of(const tinygltf::Model& model) {
  Soup soup;
  for (const SourcePart& part : gltf_triangles(model)) {
    for (std::size_t i = 0; i + 2 < part.indices.size(); i += 3) {
      const auto three = [&](const auto& values) {
        return std::array{values[part.indices[i]], values[part.indices[i + 1]], values[part.indices[i + 2]]};
      };
      soup.corners.push_back(three(part.positions));
      soup.normals.push_back(three(part.normals));
      soup.uvs.push_back(three(part.uvs));
      soup.leaf.push_back(part.name == "leaves");
    }
  }
  return soup;
}

Soup soup_of(const Plant& plant) {
  Soup soup;
  for (const MeshPart* part : {&plant.mesh.bark, &plant.mesh.leaves}) {
    for (std::size_t i = 0; i + 2 < part->indices.size(); i += 3) {
      const auto three = [&](auto&& get) {
        const auto at = [&](std::size_t k) { return get(part->vertices[part->indices[i + k]]); };
        return std::array{at(0), at(1), at(2)};
      };
      soup.corners.push_back(three([](const MeshVertex& v) { return Vec3d(v.position); }));
      soup.normals.push_back(three([](const MeshVertex& v) { return v.normal; }));
      soup.uvs.push_back(three([](const MeshVertex& v) { return v.uv; }));
      soup.leaf.push_back(part == &plant.mesh.leaves);
    }
  }
  return soup;
}

/// Of the triangles, by shape alone.
double share_right(const Nameless& model) {
  TriangleList list;
  for (const Vec3d& p : model.part.positions) list.positions.emplace_back(p);
  list.corners = model.part.indices;
  list.uvs = model.part.uvs;
  list.source.assign(model.leaf.size(), 0);
  const auto place = joined_by_place(list.positions);
  for (const std::uint32_t c : list.corners) list.joined.push_back(place[c]);
  const Image white{1, {255, 255, 255, 255}};
  const auto found =
      classify_triangles(list, std::span(&model.part, 1), {}, [&](int) -> const Image& { return white; });
  double right = 0;
  for (std::size_t t = 0; t < model.leaf.size(); ++t) right += (found.part[t] != PlantPart::branch) == model.leaf[t];
  return right / static_cast<double>(model.leaf.size());
}

constexpr const char* kTrees[] = {"ash_medium", "aspen_medium_modelled", "oak_dense", "oak_medium", "pine_medium"};

}  // namespace

TEST_CASE("triangles of real trees without names and ids are told by shape") {
  for (const std::string name : kTrees) {
    const auto file = data_file("trees/" + name + ".glb");
    if (!file) return;
    const Soup soup = soup_of(load_gltf(read_file(*file), std::nullopt));
    const double bare = share_right(shuffled(soup, false)), with_uvs = share_right(shuffled(soup, true));
    INFO(name << ": " << bare << " without and " << with_uvs << " with texture coordinates");
    CHECK(bare >= 0.95);
    CHECK(with_uvs >= 0.95);
  }
}

TEST_CASE("triangles of grown trees without names are told by shape") {
  for (const std::string_view name : kSpeciesNames) {
    for (const std::uint64_t seed : {1, 2}) {
      const double right = share_right(shuffled(soup_of(grow_plant(builtin_species(name), seed)), false));
      INFO(name << " seed " << seed << ": " << right);
      CHECK(right >= 0.95);
    }
  }
}

namespace {

/// A card 1 high at `x`.
SourcePart card(double x) {
  SourcePart part;
  part.positions = {{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 0, 1}, {x, 0, 1}};
  part.normals.assign(4, Vec3(0, -1, 0));
  part.uvs.assign(4, Vec2(0));
  part.indices = {0, 1, 2, 0, 2, 3};
  return part;
}

/// What assemble_plant takes a lone part for, and why.
std::pair<bool, Reason> taken(const std::vector<SourcePart>& parts, const std::vector<SourceMaterial>& materials = {}) {
  const TakenFor found = assemble_plant("it", parts, materials).taken;
  for (std::size_t r = 0; r < kReasons; ++r) {
    if (found.branch[r] > 0) return {true, static_cast<Reason>(r)};
    if (found.terminal[r] > 0) return {false, static_cast<Reason>(r)};
  }
  FAIL("nothing was taken for anything");
  return {};
}

SourceMaterial material(const std::string& name, std::uint8_t green = 255) {
  return {name, std::nullopt, false, [green] { return Image{1, {100, green, 100, 255}}; }};
}

}  // namespace

TEST_CASE("what says more is believed first: extras, the material, alpha, the name, ids, the shape") {
  SourcePart part = card(0);
  CHECK(taken({part}) == std::pair{false, Reason::shape});
  SourcePart with_ids = card(5);
  with_ids.branch_ids = {0, 0, 0, 0};
  const TakenFor ids = assemble_plant("it", std::vector{part, with_ids}, {}).taken;
  CHECK(ids.branch[static_cast<std::size_t>(Reason::branch_ids)] == 2);
  CHECK(ids.terminal[static_cast<std::size_t>(Reason::branch_ids)] == 2);
  part.name = "Trunk.001";
  CHECK(taken({part}) == std::pair{true, Reason::name});
  part.material = 0;
  SourceMaterial look = material("plain");
  look.cut_out = true;
  CHECK(taken({part}, {look}) == std::pair{false, Reason::alpha});
  look.name = "oak_BARK";
  CHECK(taken({part}, {look}) == std::pair{true, Reason::material});
  look.told = PlantPart::flower;
  CHECK(taken({part}, {look}) == std::pair{false, Reason::extras});
  part.told = PlantPart::branch;
  CHECK(taken({part}, {look}) == std::pair{true, Reason::extras});
}

TEST_CASE("names of organs make terminals of that organ") {
  for (const auto& [name, organ] : {std::pair{"cherry blossom", Organ::flower}, std::pair{"Fruits", Organ::fruit},
                                    std::pair{"leaves", Organ::leaf}}) {
    SourcePart part = card(0);
    part.name = name;
    const Plant plant = assemble_plant("it", std::vector{part}, {}).plant;
    check_runs(plant);
    REQUIRE(plant.terminals.size() == 1);
    CHECK(plant.terminals[0].organ == organ);
    CHECK(plant.terminals[0].branch == -1);
  }
}

TEST_CASE("green tells where the shape does not, and what is left over stands on the ground") {
  // A pyramid: neither flat nor slender.
  SourcePart cone;
  cone.positions = {{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}, {0, 0, 3}};
  cone.normals.assign(5, Vec3(0, 0, 1));
  cone.uvs.assign(5, Vec2(0));
  cone.indices = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
  cone.material = 0;
  CHECK(taken({cone}, {material("a", 200)}) == std::pair{false, Reason::colour});
  CHECK(taken({cone}, {material("a", 50)}) == std::pair{true, Reason::rest});  // alone, it is what stands there
  SourcePart leaf = card(3);
  leaf.name = "leaf";
  const TakenFor both = assemble_plant("it", std::vector{cone, leaf}, std::vector{material("a", 50)}).taken;
  CHECK(both.branch[static_cast<std::size_t>(Reason::rest)] == 4);
}

TEST_CASE("a stray vertex that no triangle uses does not weld the plant") {
  SourcePart part = card(0);
  part.positions.emplace_back(1e30, 0, 0);
  part.normals.emplace_back(0, 0, 1);
  part.uvs.emplace_back(0);
  const Plant plant = assemble_plant("it", std::vector{part}, {}).plant;
  CHECK(plant.mesh.leaves.vertices.size() == 4);
  check_runs(plant);
}

TEST_CASE("real models are taken for what they are") {
  const struct {
    const char* file;
    std::size_t branches, bark, leaves;  // triangles
    Reason why_leaf;
  } cases[] = {{"treemodel/eztree-oak_medium.glb", 140, 3166, 10640, Reason::material},
               {"treemodel/eztree-pine_medium.glb", 83, 10032, 9840, Reason::material},
               {"treemodel/kenney-palm-detailed-long.glb", 1, 36, 452, Reason::material},
               {"treemodel/kenney-tree-big.glb", 1, 142, 414, Reason::colour},
               {"treemodel/lime-lowpoly.glb", 2, 23, 896, Reason::colour},
               {"treemodel/spruce-lowpoly.glb", 1, 23, 202, Reason::colour},
               {"treemodel/potted-plant-khronos.glb", 479, 59114, 10692, Reason::material}};
  for (const auto& c : cases) {
    const auto file = data_file(c.file);
    if (!file) return;
    INFO(c.file);
    const PlantReading reading = examine_plant(*file);
    check_runs(reading.plant);
    CHECK(reading.plant.branches.size() == c.branches);
    CHECK(reading.plant.mesh.bark.triangles() == c.bark);
    CHECK(reading.plant.mesh.leaves.triangles() == c.leaves);
    CHECK(reading.taken.terminal[static_cast<std::size_t>(c.why_leaf)] == c.leaves);
  }
}

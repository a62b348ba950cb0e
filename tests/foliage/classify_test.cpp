#include "foliage/import/classify_triangles.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "foliage/generate.h"
#include "foliage/import/assemble_plant.h"
#include "foliage/import/gltf_files.h"
#include "foliage/import/gltf_materials.h"
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

// Planned buildings from glTF: their hierarchy, what they share, and what cannot be read.
#include "scenegraph/import/model_file.h"

#include <catch2/catch.hpp>
#include <string>

using namespace manzana;

namespace {

/// Two walls that share a mesh of one triangle, below a house that is moved; y up.
std::string house_gltf(const std::string& wall_mesh = "0") {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[
    {"name":"house","translation":[0,0,-10],"children":[1,2]},
    {"name":"front","mesh":)" +
         wall_mesh + R"(},{"name":"back","mesh":0,"translation":[0,5,0],"scale":[2,2,2]}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
    "materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1]}}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
    "bufferViews":[{"buffer":0,"byteLength":36}],
    "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
}

ModelFile read(const std::string& text) {
  return read_model({reinterpret_cast<const unsigned char*>(text.data()), text.size()}, "house.gltf");
}

}  // namespace

TEST_CASE("model file: names and places and shared meshes are kept") {
  const ModelFile model = read(house_gltf());
  REQUIRE(model.size() == 3);
  CHECK(model[0].name == "house");
  CHECK(model[0].parent == 0);
  CHECK(model[1].parent == 1);
  CHECK(model[2].parent == 1);
  CHECK(model[1].mesh == model[2].mesh);
  REQUIRE(model[1].mesh);
  CHECK(model[1].mesh->vertices[0].colour == 0x0000FF);
  const Scene empty;
  Nodes nodes(empty);
  const NodeId house = add_model(nodes, model, {.name = "plan"});
  CHECK(nodes.size() == 4);
  const culling::BoxD box = nodes.box(house);  // -z of the file is north
  CHECK(box.min == Vec3d(0, 10, 0));
  CHECK(box.max == Vec3d(2, 10, 7));
}

TEST_CASE("model file: what is broken is told by its name") {
  CHECK_THROWS_WITH(read("{"), Catch::StartsWith("house.gltf: "));
  CHECK_THROWS_WITH(read(house_gltf("7")), Catch::StartsWith("house.gltf: there is no mesh 7"));
  CHECK_THROWS_WITH(read(R"({"asset":{"version":"2.0"}})"), Catch::StartsWith("house.gltf: "));
  CHECK_THROWS_WITH(read_model("nowhere/house.glb"), Catch::StartsWith("nowhere/house.glb: "));
}

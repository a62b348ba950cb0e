#include "foliage/import/gltf_plant.h"

#include <tiny_gltf.h>
#include <zlib.h>

#include <cmath>

#include "foliage/import/gltf_accessor.h"
#include "foliage/import/gltf_triangles.h"
#include "foliage/import/plant_image.h"
#include "tests/foliage/plant_checks.h"
#include "tests/support/data.h"

using namespace manzana;
using namespace manzana::foliage;

namespace {

/// Builds models in memory, in tinygltf's own terms.
struct Builder {
  tinygltf::Model model;

  template <class T>
  int view(const std::vector<T>& values) {
    tinygltf::Buffer buffer;
    buffer.data.resize(values.size() * sizeof(T));
    std::memcpy(buffer.data.data(), values.data(), buffer.data.size());
    tinygltf::BufferView v;
    v.buffer = static_cast<int>(model.buffers.size());
    v.byteLength = buffer.data.size();
    model.buffers.push_back(std::move(buffer));
    model.bufferViews.push_back(v);
    return static_cast<int>(model.bufferViews.size()) - 1;
  }

  int accessor(int buffer_view, int component_type, int type, std::size_t count) {
    tinygltf::Accessor a;
    a.bufferView = buffer_view;
    a.componentType = component_type;
    a.type = type;
    a.count = count;
    model.accessors.push_back(a);
    return static_cast<int>(model.accessors.size()) - 1;
  }

  int positions(const std::vector<float>& xyz) {
    return accessor(view(xyz), TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, xyz.size() / 3);
  }

  int mesh(int position, int indices = -1, int mode = TINYGLTF_MODE_TRIANGLES) {
    tinygltf::Primitive p;
    p.attributes["POSITION"] = position;
    p.indices = indices;
    p.mode = mode;
    tinygltf::Mesh m;
    m.primitives.push_back(p);
    model.meshes.push_back(m);
    return static_cast<int>(model.meshes.size()) - 1;
  }

  tinygltf::Node& node(int mesh_index, std::vector<int> children = {}) {
    tinygltf::Node n;
    n.mesh = mesh_index;
    n.children = std::move(children);
    model.nodes.push_back(n);
    return model.nodes.back();
  }
};

const std::vector<float> kTriangle{0, 0, 0, 1, 0, 0, 0, 2, 0};

bool near(const Vec3d& a, const Vec3d& b) { return glm::length(a - b) < 1e-9; }

}  // namespace

TEST_CASE("y up becomes z up, transforms are applied, children after parents") {
  Builder b;
  b.node(-1, {1}).translation = {10, 0, 0};
  auto& child = b.node(b.mesh(b.positions(kTriangle)));
  child.scale = {2, 2, 2};
  child.rotation = {0, std::sqrt(0.5), 0, std::sqrt(0.5)};  // 90 degrees about y: x -> -z
  const auto parts = gltf_triangles(b.model);
  REQUIRE(parts.size() == 1);
  CHECK(near(parts[0].positions[0], {10, 0, 0}));
  CHECK(near(parts[0].positions[1], {10, 2, 0}));  // y up: (10, 0, -2)
  CHECK(near(parts[0].positions[2], {10, 0, 4}));
}

TEST_CASE("a mirror turns triangles round, so that normals keep to the outside") {
  for (const double mirror : {1.0, -1.0}) {
    Builder b;
    b.node(b.mesh(b.positions(kTriangle))).scale = {mirror, 1, 1};
    const auto part = gltf_triangles(b.model).at(0);
    const Vec3d n = glm::cross(part.positions[part.indices[1]] - part.positions[part.indices[0]],
                               part.positions[part.indices[2]] - part.positions[part.indices[0]]);
    CHECK(n.y < 0);  // +z in glTF is -y here, mirrored or not
    CHECK(part.normals[0].y == Approx(-1));
  }
}

TEST_CASE("nodes nested 100 000 deep are no trouble, and two parents or a cycle are refused") {
  constexpr int kDeep = 100'000;
  Builder b;
  const int mesh = b.mesh(b.positions(kTriangle));
  for (int i = 0; i < kDeep; ++i)
    b.node(i + 1 == kDeep ? mesh : -1, i + 1 == kDeep ? std::vector<int>{} : std::vector{i + 1});
  CHECK(gltf_triangles(b.model).size() == 1);
  b.model.nodes.back().children = {0};
  b.model.scenes.resize(1);
  b.model.scenes[0].nodes = {0};
  CHECK_THROWS_WITH(gltf_triangles(b.model), Catch::Contains("cycle"));
  Builder twice;
  twice.node(-1, {1, 1});
  twice.node(twice.mesh(twice.positions(kTriangle)));
  CHECK_THROWS_WITH(gltf_triangles(twice.model), Catch::Contains("two parents"));
}

TEST_CASE("nodes scaled to nothing are left out") {
  Builder b;
  const int mesh = b.mesh(b.positions(kTriangle));
  b.node(mesh, {2}).scale = {0, 1, 1};
  b.node(mesh);
  b.node(mesh);
  CHECK(gltf_triangles(b.model).size() == 1);
}

TEST_CASE("extras say what organ a node, a mesh or a primitive is, the nearest to the triangles first") {
  const auto organ = [](const char* name) {
    return tinygltf::Value(tinygltf::Value::Object{{"organ", tinygltf::Value(std::string(name))}});
  };
  Builder b;
  b.node(b.mesh(b.positions(kTriangle))).extras = organ("fruit");
  CHECK(gltf_triangles(b.model).at(0).told == PlantPart::fruit);
  b.model.meshes[0].extras = organ("branch");
  CHECK(gltf_triangles(b.model).at(0).told == PlantPart::branch);
  b.model.meshes[0].primitives[0].extras = organ("leaf");
  CHECK(gltf_triangles(b.model).at(0).told == PlantPart::leaf);
  b.model.meshes[0].primitives[0].extras = organ("windmill");
  CHECK(gltf_triangles(b.model).at(0).told == PlantPart::branch);
  b.model.nodes[0].extras = tinygltf::Value(3);
  b.model.meshes[0].extras = tinygltf::Value(tinygltf::Value::Object{{"organ", tinygltf::Value(3)}});
  CHECK(!gltf_triangles(b.model).at(0).told);
}

TEST_CASE("branch ids are whole numbers from 0, one for each vertex") {
  Builder b;
  b.node(b.mesh(b.positions(kTriangle)));
  auto& attributes = b.model.meshes[0].primitives[0].attributes;
  CHECK(gltf_triangles(b.model).at(0).branch_ids.empty());
  const auto ids = [&](const std::vector<float>& values) {
    attributes["_BRANCHID"] =
        b.accessor(b.view(values), TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR, values.size());
  };
  ids({4, 4, 5});
  CHECK(gltf_triangles(b.model).at(0).branch_ids == std::vector<std::int32_t>{4, 4, 5});
  ids({4, 4});
  CHECK_THROWS_WITH(gltf_triangles(b.model), Catch::Contains("differ in count"));
  for (const float bad : {-1.0F, 1e9F, std::nanf("")}) {
    ids({4, 4, bad});
    CHECK_THROWS_WITH(gltf_triangles(b.model), Catch::Contains("_BRANCHID is not within"));
  }
}

TEST_CASE("only the default scene is read") {
  Builder b;
  const int mesh = b.mesh(b.positions(kTriangle));
  b.node(mesh);
  b.node(mesh).translation = {5, 0, 0};
  b.model.scenes.resize(2);
  b.model.scenes[0].nodes = {0};
  b.model.scenes[1].nodes = {1};
  b.model.defaultScene = 1;
  const auto parts = gltf_triangles(b.model);
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].positions[0].x == 5);
  b.model.defaultScene = 2;
  CHECK_THROWS_WITH(gltf_triangles(b.model), Catch::Contains("scene 2"));
}

TEST_CASE("strips and fans give the triangles of the specification") {
  const std::vector<float> five{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0};
  Builder strip;
  strip.node(strip.mesh(strip.positions(five), -1, TINYGLTF_MODE_TRIANGLE_STRIP));
  CHECK(gltf_triangles(strip.model)[0].indices == std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2, 2, 3, 4});
  Builder fan;
  fan.node(fan.mesh(fan.positions(five), -1, TINYGLTF_MODE_TRIANGLE_FAN));
  CHECK(gltf_triangles(fan.model)[0].indices == std::vector<std::uint32_t>{1, 2, 0, 2, 3, 0, 3, 4, 0});
  Builder lines;
  lines.node(lines.mesh(lines.positions(five), -1, TINYGLTF_MODE_LINE));
  CHECK_THROWS_WITH(gltf_triangles(lines.model), Catch::Contains("no triangles"));
}

TEST_CASE("accessors: normalised integers, strides, sparse values, zeros without a view") {
  Builder b;
  const int bytes = b.accessor(b.view(std::vector<std::int8_t>{127, -128, 0, 64}), TINYGLTF_COMPONENT_TYPE_BYTE,
                               TINYGLTF_TYPE_VEC2, 2);
  b.model.accessors[static_cast<std::size_t>(bytes)].normalized = true;
  const auto n = read_values(b.model, bytes, 2);
  CHECK(n[0] == 1);
  CHECK(n[1] == -1);
  CHECK(n[3] == Approx(64 / 127.0));

  const int view = b.view(std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8});
  b.model.bufferViews[static_cast<std::size_t>(view)].byteStride = 16;
  const int strided = b.accessor(view, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC2, 2);
  b.model.accessors[static_cast<std::size_t>(strided)].byteOffset = 8;
  CHECK(read_values(b.model, strided, 2) == std::vector<double>{3, 4, 7, 8});
  b.model.accessors[static_cast<std::size_t>(strided)].byteOffset = 12;
  CHECK_THROWS_WITH(read_values(b.model, strided, 2), Catch::Contains("past its buffer view"));

  const int sparse = b.accessor(-1, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR, 4);
  CHECK(read_values(b.model, sparse, 1) == std::vector<double>{0, 0, 0, 0});
  const int at = b.view(std::vector<std::uint16_t>{1, 3}), with = b.view(std::vector<float>{10, 30});
  auto& s = b.model.accessors[static_cast<std::size_t>(sparse)].sparse;
  s = {2, true, {0, at, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT}, {with, 0}};
  CHECK(read_values(b.model, sparse, 1) == std::vector<double>{0, 10, 0, 30});
  s.indices.bufferView = b.view(std::vector<std::uint16_t>{1, 4});
  CHECK_THROWS_WITH(read_values(b.model, sparse, 1), Catch::Contains("sparse index"));
  s.count = 5;
  CHECK_THROWS(read_values(b.model, sparse, 1));
  CHECK_THROWS_WITH(read_values(b.model, 99, 1), Catch::Contains("does not exist"));
  CHECK_THROWS_WITH(read_values(b.model, sparse, 3), Catch::Contains("type"));
  CHECK_THROWS_WITH(read_indices(b.model, sparse), Catch::Contains("unsigned"));
}

TEST_CASE("meshes that are drawn a thousand times over stop at the limit") {
  Builder b;
  const int mesh = b.mesh(b.accessor(-1, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, 1'000'000));
  for (int i = 0; i < 1000; ++i) b.node(mesh);
  CHECK_THROWS_WITH(gltf_triangles(b.model), Catch::Contains("more triangles"));
}

namespace {
void append_chunk(std::vector<unsigned char>& png, const std::string& type, const std::vector<unsigned char>& data) {
  const auto number = [&](std::uint64_t v) {
    for (const int shift : {24, 16, 8, 0}) png.push_back(static_cast<unsigned char>(v >> shift));
  };
  number(data.size());
  const std::size_t start = png.size();
  png.insert(png.end(), type.begin(), type.end());
  png.insert(png.end(), data.begin(), data.end());
  number(crc32(0, &png[start], static_cast<uInt>(png.size() - start)));
}

/// A grey PNG of that size, with `bytes` zeros as its data.
std::vector<unsigned char> png_of(unsigned char size, std::size_t bytes) {
  std::vector<unsigned char> png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  append_chunk(png, "IHDR", {0, 0, size, 1, 0, 0, size, 1, 8, 0, 0, 0, 0});
  const std::vector<unsigned char> zeros(bytes, 0);
  uLongf packed = compressBound(bytes);
  std::vector<unsigned char> data(packed);
  compress(data.data(), &packed, zeros.data(), bytes);
  data.resize(packed);
  append_chunk(png, "IDAT", data);
  append_chunk(png, "IEND", {});
  return png;
}
}  // namespace

TEST_CASE("pictures that are bombs are refused before they are decoded") {
  const Picture good = decode_picture(png_of(0, 2));
  CHECK(good.width == 1);
  CHECK(good.rgba == std::vector<std::uint8_t>{0, 0, 0, 255});
  CHECK_THROWS_WITH(decode_picture(png_of(0, 40'000'000)), Catch::Contains("inflates to more"));
  CHECK_THROWS_WITH(decode_picture(png_of(0x20, 2)), Catch::Contains("16 Mi"));  // 8193 x 8193
  CHECK_THROWS_WITH(decode_picture(png_of(1, 2)), Catch::Contains("cannot be decoded"));
  CHECK_THROWS_WITH(decode_picture(std::vector<unsigned char>{'G', 'I', 'F', '8'}), Catch::Contains("neither"));
}

TEST_CASE("real trees: kinds told apart, of the right height") {
  const struct {
    const char* file;
    bool leaves;
    double height;
  } cases[] = {{"trees/oak_medium.glb", true, 64.7},
               {"trees/aspen_medium_modelled.glb", true, 69.9},
               {"trees/oak_dense.glb", true, 98.3},
               {"treemodel/eztree-bush_1.glb", true, 30.1},
               {"treemodel/kenney-tree-big.glb", true, 0.767},
               {"treemodel/lime-lowpoly.glb", true, 5},
               {"treemodel/spruce-lowpoly.glb", true, 6},
               {"treemodel/potted-plant-khronos.glb", true, 0.841}};
  for (const auto& c : cases) {
    const auto file = data_file(c.file);
    if (!file) return;
    INFO(c.file);
    const Plant plant = read_plant(*file);
    check_plant(plant);
    CHECK(static_cast<double>(measure(plant.mesh).height) == Approx(c.height).epsilon(0.01));
    CHECK(plant.mesh.bark.triangles() > 0);
    CHECK((plant.mesh.leaves.triangles() > 0) == c.leaves);
  }
}

TEST_CASE("leaf textures of real trees keep their alpha, bark is opaque") {
  const auto file = data_file("trees/oak_medium.glb");
  if (!file) return;
  const Plant plant = read_plant(*file);
  std::size_t holes = 0, bark_holes = 0;
  for (std::size_t i = 3; i < plant.leaf_image.rgba.size(); i += 4) {
    holes += plant.leaf_image.rgba[i] < 128;
    bark_holes += plant.bark_image.rgba[i] < 255;
  }
  CHECK(holes > 256 * 256 / 4);
  CHECK(holes < 256 * 256 * 9 / 10);
  CHECK(bark_holes == 0);
}

#include <chrono>
#include <fstream>
#include <map>

#include "foliage/import/gltf_plant.h"
#include "tests/foliage/plant_checks.h"
#include "tests/support/data.h"

using namespace manzana::foliage;
namespace fs = std::filesystem;

namespace {

/// What read_plant says, or nothing if it reads the file.
std::string complaint(const fs::path& file) {
  try {
    check_plant(read_plant(file));
    return "";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

void write(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

/// A fresh folder that goes with the test.
struct Folder {
  fs::path path;
  explicit Folder(const std::string& name) : path(fs::temp_directory_path() / ("manzana-foliage-" + name)) {
    fs::remove_all(path);
    fs::create_directories(path / "inside");
  }
  ~Folder() { fs::remove_all(path); }
};

std::string with_buffer(const std::string& uri) {
  return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":")" + uri +
         R"("}],"bufferViews":[{"buffer":0,"byteLength":36}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}]})";
}

std::string triangle_bytes() {
  const float xyz[] = {1, 0, 0, -1, 0, 0, 0, 2, 0};
  return {reinterpret_cast<const char*>(xyz), sizeof xyz};
}

}  // namespace

TEST_CASE("every broken glTF is refused in one line that names the file and the trouble") {
  const std::map<std::string, std::string> expected{{"accessor-out-of-range.gltf", "reads past its buffer view"},
                                                    {"bad-enum.gltf", "5999"},
                                                    {"bufferview-out-of-range.gltf", "bufferViews[0]"},
                                                    {"dangling-references.gltf", "out of bounds"},
                                                    {"index-over-vertex-count.gltf", "index 65535 of 146 vertices"},
                                                    {"json-chunk-lie.glb", "JSON chunk is longer"},
                                                    {"length-lie.glb", "cut off"},
                                                    {"missing-buffer.gltf", "no-such-file.bin"},
                                                    {"nan-positions.gltf", "position 0 is not finite"},
                                                    {"negative-offset.gltf", "byteOffset is -4"},
                                                    {"no-bin-chunk.glb", "binary data"},
                                                    {"node-cycle.gltf", "cycle"},
                                                    {"singular-transform.gltf", "no quaternion"},
                                                    {"truncated.glb", "cut off"},
                                                    {"unknown-required-extension.gltf", "EXT_not_there"},
                                                    {"uri-path-traversal.gltf", "outside its folder"},
                                                    {"version-1.glb", "version 1"}};
  const auto folder = data_file("broken/gltf");
  if (!folder) return;
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(*folder)) {
    const std::string name = entry.path().filename();
    INFO(name);
    ++count;
    REQUIRE(expected.count(name) == 1);
    const auto start = std::chrono::steady_clock::now();
    const std::string said = complaint(entry.path());
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(5));
    CHECK_THAT(said, Catch::StartsWith(entry.path().string() + ": ") && Catch::Contains(expected.at(name)));
    CHECK(said.find('\n') == std::string::npos);
  }
  CHECK(count == expected.size());
}

TEST_CASE("Draco is refused clearly") {
  for (const char* name : {"treemodel/kenney-tree-big.draco.gltf", "treemodel/kenney-palm-detailed-long.draco.gltf"}) {
    const auto file = data_file(name);
    if (!file) return;
    CHECK_THAT(complaint(*file), Catch::Contains("KHR_draco_mesh_compression"));
  }
}

TEST_CASE("buffers are read from the file's folder and below, and from nowhere else") {
  const Folder folder("sandbox");
  const fs::path inside = folder.path / "inside";
  fs::create_directories(inside / "sub");
  write(inside / "good.bin", triangle_bytes());
  write(inside / "sub/good.bin", triangle_bytes());
  write(folder.path / "secret.bin", triangle_bytes());
  fs::create_symlink(folder.path / "secret.bin", inside / "link.bin");
  fs::create_symlink(folder.path, inside / "up");
  fs::create_symlink("good.bin", inside / "near.bin");
  const auto said = [&](const std::string& uri) {
    write(inside / "plant.gltf", with_buffer(uri));
    return complaint(inside / "plant.gltf");
  };
  CHECK(said("good.bin").empty());
  CHECK(said("./good.bin").empty());
  CHECK(said("sub/good.bin").empty());
  CHECK(said("near.bin").empty());  // a link that stays inside
  CHECK(said("%67ood.bin").empty());
  const std::string full = (folder.path / "secret.bin").string();
  for (const std::string& uri :
       {std::string("../secret.bin"), std::string("sub/../../secret.bin"), full, std::string("link.bin"),
        std::string("up/secret.bin"), std::string("%2e%2e/secret.bin")}) {
    INFO(uri);
    CHECK_THAT(said(uri), Catch::Contains("outside its folder"));
  }
  CHECK_THAT(said("sub"), Catch::Contains("sub"));  // a folder is no file
  CHECK_THAT(said("good.bin/none"), Catch::Contains("none"));
  CHECK_THAT(said("http://example.org/a.bin"), Catch::Contains("a.bin"));
}

TEST_CASE("a relative file beside the working directory is still held to its own folder") {
  const Folder folder("relative");
  write(folder.path / "inside/plant.gltf", with_buffer("only-outside.bin"));
  write(folder.path / "only-outside.bin", triangle_bytes());
  const fs::path before = fs::current_path();
  fs::current_path(folder.path);
  const std::string said = complaint("inside/plant.gltf");
  fs::current_path(before);
  CHECK_THAT(said, Catch::Contains("only-outside.bin"));
}

TEST_CASE("files from memory read no others") {
  const std::string text = with_buffer("good.bin");
  const std::span bytes(reinterpret_cast<const unsigned char*>(text.data()), text.size());
  CHECK_THROWS_WITH(read_plant(bytes, "memory"), Catch::StartsWith("memory: refers to the file good.bin"));
}

TEST_CASE("plants of no size, or of more than a million metres, are refused") {
  const Folder folder("size");
  for (const float extent : {0.0F, 1e-20F, 1e19F, 1e38F}) {
    const float xyz[] = {extent, 0, 0, -extent, 0, 0, 0, 2, 0};
    write(folder.path / "t.bin", {reinterpret_cast<const char*>(xyz), sizeof xyz});
    write(folder.path / "plant.gltf", with_buffer("t.bin"));
    CHECK_THAT(complaint(folder.path / "plant.gltf"), Catch::Contains("a plant of"));
  }
}

TEST_CASE("files that are no glTF are refused") {
  const Folder folder("odd");
  const auto said = [&](const std::string& text) {
    write(folder.path / "plant.gltf", text);
    return complaint(folder.path / "plant.gltf");
  };
  CHECK_THAT(complaint(folder.path / "absent.glb"), Catch::Contains("no such file"));
  CHECK_THAT(complaint(folder.path), Catch::Contains("no such file"));
  CHECK_FALSE(said("").empty());
  CHECK_FALSE(said("glTF").empty());
  CHECK_FALSE(said("{}").empty());
  CHECK_FALSE(said("[]").empty());
  CHECK_THAT(said(R"({"asset":{"version":"1.0"}})"), Catch::Contains("asset.version"));
  CHECK_THAT(said(R"({"asset":{"version":"2.0"}})"), Catch::Contains("no triangles"));
  const std::string deep(100'000, '[');
  CHECK_THAT(said(R"({"asset":{"version":"2.0"},"extras":)" + deep), Catch::Contains("nested deeper"));
  CHECK_THAT(said(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":2000000000}]})"),
             Catch::Contains("byteLength"));
  CHECK_THAT(
      said(R"({"asset":{"version":"2.0"},"accessors":[{"count":4000000000000,"componentType":5126,"type":"VEC3"}]})"),
      Catch::Contains("count"));
  fs::resize_file(folder.path / "plant.gltf", 300U << 20);  // sparse on disk
  CHECK_THAT(complaint(folder.path / "plant.gltf"), Catch::Contains("larger than"));
}

TEST_CASE("a GLB cut or altered anywhere is refused or read, never worse") {
  const auto file = data_file("treemodel/spruce-lowpoly.glb");
  if (!file) return;
  std::ifstream in(*file, std::ios::binary);
  const std::string good((std::istreambuf_iterator<char>(in)), {});
  const auto tried = [](const std::string& bytes) {
    try {
      check_plant(read_plant(std::span(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()), "it"));
      return 1;
    } catch (const std::runtime_error&) {
      return 0;
    }
  };
  CHECK(tried(good) == 1);
  for (std::size_t i = 0; i < 40; ++i) CHECK(tried(good.substr(0, good.size() * i / 40)) == 0);
  int read = 0;
  for (std::size_t i = 0; i < 60; ++i) {
    std::string bad = good;
    bad[20 + i * 37 % 1200] ^= static_cast<char>(1 << i % 8);
    read += tried(bad);
  }
  CHECK(read < 60);
}

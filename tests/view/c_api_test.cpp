// The C header does what the C++ one does, and shows nothing else.
#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>

#include "foliage/import/load_plant.h"
#include "manzana/manzana.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"
#include "tests/view/worn_house.h"

using namespace manzana;

extern "C" manzana_camera c_camera(int width, int height);

namespace {

constexpr int kWidth = 200, kHeight = 120;

manzana_camera as_c(const HostCamera& camera) {
  manzana_camera c = c_camera(camera.viewport.width, camera.viewport.height);
  std::memcpy(c.projection, &camera.projection[0].x, sizeof c.projection);
  std::memcpy(c.view, &camera.view[0].x, sizeof c.view);
  return c;
}

constexpr double kIdentity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

constexpr const char* kTriangleGltf = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
  "nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
  "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
  "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,
  "uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

manzana_model* load(const char* city, manzana_error* error) {
  manzana_load_options options = manzana_load_defaults();
  options.cars = 0;
  options.trees = 0;
  return manzana_model_load(city, &options, nullptr, nullptr, error);
}

}  // namespace

TEST_CASE("c: a picture and what is picked in it") {
  const gl::HeadlessContext context;
  const HostWindow window(kWidth, kHeight);
  manzana_error error{};
  manzana_model* city = load("builtin:town", &error);
  REQUIRE(city != nullptr);
  int repaints = 0;
  const manzana_host host{&repaints, nullptr, [](void* n) { ++*static_cast<int*>(n); }, nullptr, nullptr};
  manzana_view* view = manzana_view_create(&host, nullptr);
  manzana_view_show(view, city);
  const manzana_camera camera = as_c(street_camera(kWidth, kHeight));
  manzana_update update{};
  manzana_seen seen{};
  for (int frame = 0; frame < 100 && update.shown == 0; ++frame) {
    window.bind();
    REQUIRE(manzana_view_render(view, 0, &error) == 1);
    manzana_view_update(view, &camera, 1, 0, &update, &seen);
  }
  REQUIRE(update.shown == 1);
  CHECK(repaints > 0);
  CHECK(seen.buildings > 50);
  window.clear(0, 0, 0, 0);
  REQUIRE(manzana_view_render(view, 0, &error) == 1);
  const auto pixels = window.pixels();
  std::vector<std::uint32_t> ids(kWidth * kHeight);
  REQUIRE(manzana_view_pick(view, 0, 0, 0, kWidth, kHeight, ids.data(), &error) == 1);
  std::size_t same = 0, wrong = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    same += (ids[i] != 0) == (pixels[i].c[3] > 0) ? 1 : 0;
    manzana_feature feature{};
    if (ids[i] != 0 && manzana_model_feature(city, ids[i], &feature) != 1) ++wrong;
  }
  CHECK(static_cast<double>(same) > 0.97 * static_cast<double>(ids.size()));
  CHECK(wrong == 0);
  manzana_drawing drawing = manzana_view_drawing(view);
  CHECK(drawing.sky == 0);
  drawing.buildings = 0;
  manzana_view_set_drawing(view, &drawing);
  window.clear(0, 0, 0, 0);
  REQUIRE(manzana_view_render(view, 0, &error) == 1);
  CHECK(share_different(window.pixels(), pixels, 8) > 0.1);
  CHECK(manzana_view_pick(view, 0, 0, 0, 0, 5, ids.data(), &error) == 0);
  CHECK(std::string(error.text) == "a rectangle without pixels");
  manzana_view_release(view);
  manzana_view_free(view);
  manzana_model_free(city);
}

TEST_CASE("c: far trees are made by the host's tasks and the picture is complete then") {
  const gl::HeadlessContext context;
  const HostWindow window(kWidth, kHeight);
  manzana_error error{};
  const std::string cache = foliage::default_cache_folder().value_or("").string();
  manzana_load_options options = manzana_load_defaults();
  options.cars = 0;
  options.plant_cache = cache.empty() ? nullptr : cache.c_str();
  manzana_model* city = manzana_model_load("builtin:town", &options, nullptr, nullptr, &error);
  REQUIRE(city != nullptr);
  int tasks = 0;
  const manzana_host host{&tasks, nullptr, nullptr, nullptr, [](void* n, void (*task)(void*), void* argument) {
                            ++*static_cast<int*>(n);
                            task(argument);  // at once
                          }};
  manzana_view* view = manzana_view_create(&host, nullptr);
  manzana_view_show(view, city);
  const manzana_camera camera = as_c(street_camera(kWidth, kHeight));
  manzana_update update{};
  CHECK(manzana_view_complete(view) == 0);
  for (int frame = 0; frame < 1000 && manzana_view_complete(view) == 0; ++frame) {
    manzana_view_update(view, &camera, 1, 0, &update, nullptr);
    window.bind();
    REQUIRE(manzana_view_render(view, 0, &error) == 1);
  }
  CHECK(manzana_view_complete(view) == 1);
  manzana_view_update(view, &camera, 1, 0, &update, nullptr);
  CHECK(update.far_trees_left == 0);
  CHECK(tasks > 0);
  manzana_view_release(view);
  manzana_view_free(view);
  manzana_model_free(city);
}

TEST_CASE("c: pictures that are being made are told of") {
  const gl::HeadlessContext context;
  const TemporaryFolder folder;
  worn_house::write_quarters(folder.path() / "quarters.png");
  const std::string file = worn_house::written(folder.path(), worn_house::house("wrap", {0, 0}, {1, 1})).string();
  const manzana_camera camera = as_c(worn_house::before_wall(Model::load(file, {.cars = 0, .trees = false})->scene()));
  manzana_error error{};
  manzana_model* city = manzana_model_load(file.c_str(), nullptr, nullptr, nullptr, &error);
  REQUIRE(city != nullptr);
  const HostWindow window(worn_house::kWidth, worn_house::kHeight);
  using Task = std::pair<void (*)(void*), void*>;
  std::vector<Task> tasks;
  const manzana_host host{&tasks, nullptr, nullptr, nullptr, [](void* list, void (*task)(void*), void* argument) {
                            static_cast<std::vector<Task>*>(list)->emplace_back(task, argument);
                          }};
  manzana_view* view = manzana_view_create(&host, nullptr);
  manzana_view_show(view, city);
  const auto left = [&] {
    manzana_update update{};
    for (int frame = 0; frame < 20; ++frame) {
      manzana_view_update(view, &camera, 1, 0, &update, nullptr);
      window.bind();
      REQUIRE(manzana_view_render(view, 0, &error) == 1);
    }
    return update.pictures_left;
  };
  CHECK(left() == 1);
  for (const auto& [task, argument] : std::vector(tasks)) task(argument);
  CHECK(left() == 0);
  CHECK(manzana_view_complete(view) == 1);
  manzana_view_release(view);
  manzana_view_free(view);
  manzana_model_free(city);
}

TEST_CASE("c: what a file says of a feature is given") {
  manzana_error error{};
  const std::string osm =
      R"(<osm version="0.6"><node id="1" lat="50" lon="8"/><node id="2" lat="50.0002" lon="8"/>
      <node id="3" lat="50.0002" lon="8.0003"/><way id="1"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="1"/>
      <tag k="building" v="yes"/><tag k="name" v="Rathaus"/></way></osm>)";
  for (const int wanted : {1, 0}) {
    manzana_load_options options = manzana_load_defaults();
    CHECK(options.attributes == 1);
    options.attributes = wanted;
    options.trees = 0;
    manzana_model* city =
        manzana_model_load_bytes(osm.data(), osm.size(), "osm", "x", &options, nullptr, nullptr, &error);
    REQUIRE(city != nullptr);
    int found = 0;
    for (std::uint32_t id = 0; id <= manzana_model_features(city) + 1; ++id)
      for (std::uint32_t i = 0; i < manzana_model_attributes(city, id); ++i) {
        const char *name = nullptr, *value = nullptr;
        REQUIRE(manzana_model_attribute(city, id, i, &name, &value) == 1);
        found += std::string(name) == "name" && std::string(value) == "Rathaus" ? 1 : 0;
        CHECK(manzana_model_attribute(city, id, 99, &name, &value) == 0);
      }
    CHECK(found == wanted);
    manzana_model_free(city);
  }
}

TEST_CASE("c: nodes are put in and moved and found and gone") {
  manzana_error error{};
  manzana_model* city = load("builtin:town", &error);
  REQUIRE(city != nullptr);
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "house.gltf").string();
  std::ofstream(file) << kTriangleGltf;
  manzana_nodes* nodes = manzana_nodes_create(city);
  const double here[3] = {100, 0, 0}, there[3] = {200, 0, 0};
  double placement[16];
  manzana_model_upright(city, here, 90, placement);
  const std::uint32_t layer = manzana_nodes_add(nodes, 0, kIdentity, "planned", &error);
  REQUIRE(layer > manzana_model_features(city));
  const std::uint32_t house = manzana_nodes_add_model(nodes, file.c_str(), layer, placement, &error);
  REQUIRE(house != 0);
  manzana_node node{};
  REQUIRE(manzana_nodes_node(nodes, house, &node) == 1);
  CHECK(node.parent == layer);
  CHECK(node.visible == 1);
  CHECK(node.low[0] == Approx(100).margin(0.01));
  manzana_model_upright(city, there, 0, placement);
  CHECK(manzana_nodes_move(nodes, house, placement, &error) == 1);
  const std::uint32_t second = manzana_nodes_copy(nodes, house, layer, placement, &error);
  REQUIRE(second > house);
  CHECK(manzana_nodes_paint(nodes, second, 0xff0000, &error) == 1);
  CHECK(manzana_nodes_hang(nodes, second, house, &error) == 1);
  CHECK(manzana_nodes_hang(nodes, house, second, &error) == 0);
  CHECK(std::string(error.text) == "a node cannot hang below itself");
  CHECK(manzana_nodes_show(nodes, layer, 0, &error) == 1);
  REQUIRE(manzana_nodes_node(nodes, house, &node) == 1);
  CHECK(node.visible == 0);
  CHECK(node.low[0] == Approx(200).margin(0.01));
  CHECK(manzana_nodes_remove(nodes, layer, &error) == 1);
  CHECK(manzana_nodes_node(nodes, second, &node) == 0);
  CHECK(manzana_nodes_add_model(nodes, "nowhere.glb", 0, kIdentity, &error) == 0);
  CHECK(std::string(error.text).starts_with("nowhere.glb: "));
  manzana_nodes_free(nodes);
  manzana_model_free(city);
}

TEST_CASE("c: places lead there and back and errors are a line") {
  manzana_error error{};
  CHECK(load("nowhere.osm", &error) == nullptr);
  CHECK(std::string(error.text).starts_with("nowhere.osm: "));
  CHECK(load("nowhere.osm", nullptr) == nullptr);
  manzana_model* city = load("builtin:town", &error);
  REQUIRE(city != nullptr);
  const double local[3] = {120, -80, 15};
  double geo[3], back[3];
  manzana_model_to_geo(city, local, geo);
  REQUIRE(manzana_model_to_local(city, geo, back) == 1);
  for (int k = 0; k < 3; ++k) CHECK(back[k] == Approx(local[k]).margin(1e-6));
  const double no_place[3] = {91, 0, 0};
  CHECK(manzana_model_to_local(city, no_place, back) == 0);
  manzana_feature feature{};
  CHECK(manzana_model_feature(city, 0, &feature) == 0);
  CHECK(manzana_model_feature(city, manzana_model_features(city) + 1, &feature) == 0);
  CHECK(std::string(manzana_model_credits(city)).empty());
  manzana_model_free(city);
}

TEST_CASE("c: the library shows its own functions and nothing else") {
  const TemporaryFolder folder;
  const Ended ended = run_program("/usr/bin/nm", folder.path(), {"-D", "--defined-only", MANZANA_LIBRARY});
  REQUIRE(ended.code == 0);
  std::istringstream lines(ended.out);
  int functions = 0;
  for (std::string address, kind, name; lines >> address >> kind >> name; ++functions) {
    INFO(name);
    CHECK(name.starts_with("manzana_"));
  }
  CHECK(functions == 42);
}

TEST_CASE("c: an orthophoto that cannot be read is told") {
  manzana_load_options options = manzana_load_defaults();
  options.orthophoto = "/nowhere/photo.tif";
  manzana_error error{};
  CHECK(manzana_model_load("builtin:town", &options, nullptr, nullptr, &error) == nullptr);
  CHECK(std::string(error.text).starts_with("/nowhere/photo.tif: "));
}

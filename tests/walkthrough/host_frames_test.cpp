// What a frame costs a host, beside the same frame of the walkthrough: one model, one context, in turns.
#include <catch2/catch.hpp>
#include <chrono>
#include <ctime>
#include <iostream>
#include <thread>

#include "apps/common/quantile.h"
#include "apps/walkthrough/builtin_paths.h"
#include "apps/walkthrough/frame.h"
#include "foliage/import/load_plant.h"
#include "scenegraph/import/scene_plants.h"
#include "tests/support/random.h"
#include "tests/view/host.h"

using namespace manzana;
using namespace manzana::walkthrough;

namespace {

constexpr draw::Size kSize{1280, 720};

std::shared_ptr<const Model> wood(std::size_t trees) {
  support::Random random(9);
  CityFeatures features;
  const double side = 8 * std::sqrt(static_cast<double>(trees));
  for (std::size_t i = 0; i < trees; ++i)
    features.trees.push_back({{random.within(0, side), random.within(0, side)}, random.within(6, 16), 3});
  Imported imported = build_scene(std::move(features), {}, {});
  auto plants = scene_plants(imported.scene, {.cache = foliage::default_cache_folder()}, {}, [](const auto&) {});
  return std::make_shared<Model>(std::move(imported), std::move(plants), foliage::default_cache_folder());
}

HostCamera host_camera(const culling::View& view) {
  HostCamera camera;
  camera.view = glm::lookAt(view.eye, view.eye + view.forward, view.up);
  camera.projection = glm::infinitePerspective(2 * std::atan(view.tan_top), 16.0 / 9, view.near_m);
  camera.viewport = {0, 0, kSize.width, kSize.height};
  return camera;
}

struct Times {
  double wall_ms = 0, processor_ms = 0;  ///< of all threads: of the two the one that other programs change less
};

template <class Frame>
Times times(Frame&& frame) {
  glFinish();
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t used = std::clock();
  frame();
  glFinish();
  return {std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count(),
          1e3 * static_cast<double>(std::clock() - used) / CLOCKS_PER_SEC};
}

Times median(const std::vector<Times>& all) {
  std::vector<double> wall, processor;
  for (const Times& t : all) wall.push_back(t.wall_ms), processor.push_back(t.processor_ms);
  return {apps::quantile(wall, 0.5), apps::quantile(processor, 0.5)};
}

struct Pair {
  Times own, host;
};

/// Both frames of one camera, everything there: medians of some rounds.
Pair measured(Stage& stage, View& view, const HostWindow& window, const culling::View& eye) {
  const HostCamera camera = host_camera(eye);
  GLint framebuffer = 0;
  window.bind();
  glGetIntegerv(GL_FRAMEBUFFER_BINDING, &framebuffer);
  const auto own = [&] {
    draw_frame(stage, eye, 5);
    stage.renderer.present(static_cast<unsigned>(framebuffer));
  };
  const auto hosts = [&] {
    window.clear(0.6F, 0.7F, 0.9F, 1);
    view.update({&camera, 1}, 5);
    view.render(0);
  };
  stage.whole = true;
  own();
  stage.whole = false;
  bring_all(view, window, camera);
  std::vector<Times> a, b;
  for (int round = 0; round < 7; ++round) a.push_back(times(own)), b.push_back(times(hosts));
  return {median(a), median(b)};
}

/// `sky`: the walkthrough draws sky and fog, which hosts have not.
void measure(const std::string& name, const std::shared_ptr<const Model>& model, std::span<const culling::View> eyes,
             bool sky) {
  const gl::HeadlessContext context;
  const HostWindow window(kSize.width, kSize.height);
  Stage stage(model->scene(), model->plants(), draw::quality_for(gl::renderer_name()), kSize);
  stage.options.layers.sky = stage.options.layers.fog = sky;
  make_far_trees(stage, model->plants());
  View view;
  view.show(model);
  std::vector<double> wall, processor;
  for (const culling::View& eye : eyes) {
    const auto [own, host] = measured(stage, view, window, eye);
    wall.push_back(host.wall_ms / own.wall_ms);
    processor.push_back(host.processor_ms / own.processor_ms);
    std::cout << name << ": walkthrough " << own.wall_ms << " ms (processor " << own.processor_ms << "), host "
              << host.wall_ms << " (" << host.processor_ms << "), ratio " << wall.back() << " (" << processor.back()
              << ")\n";
  }
  std::cout << name << (sky ? ", " : ", without sky, ") << "median ratio " << apps::quantile(wall, 0.5) << " ("
            << apps::quantile(processor, 0.5) << ")\n";
  view.release();
}

std::vector<culling::View> along(const Scene& scene, const std::string& path, int n) {
  std::vector<culling::View> eyes;
  const CameraPath p = builtin_path(path, scene);
  for (int i = 0; i < n; ++i)
    eyes.push_back(view_of(scene.frame, pose_at(p, p.begin() + p.duration() * i / n), 16.0 / 9));
  return eyes;
}

}  // namespace

TEST_CASE("hosts: a frame beside the walkthrough's", "[.bench]") {
  const auto town = Model::load("builtin:town:10", {.plant_cache = foliage::default_cache_folder()});
  const auto trees = wood(100'000);
  std::vector<culling::View> eyes;
  for (const Vec3d& eye : {Vec3d(-50, -50, 60), Vec3d(1250, -300, 400), Vec3d(1250, 1250, 30), Vec3d(1250, -900, 1500)})
    eyes.push_back(view_of(trees->frame(), {eye, {1260, 1270, 0}}, 16.0 / 9));
  for (const bool sky : {true, false}) {
    measure("builtin:town:10", town, along(town->scene(), "tour", 8), sky);
    measure("100 000 trees", trees, eyes, sky);
  }
}

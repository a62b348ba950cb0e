// What hosts get without asking: far trees as mosaics and groves, made on their threads; what stands behind buildings
// left out.
#include <tbb/global_control.h>
#include <atomic>
#include <catch2/catch.hpp>
#include <deque>
#include <filesystem>
#include <mutex>
#include <set>
#include <thread>

#include "scenegraph/horizon.h"
#include "tests/support/data.h"
#include "tests/view/host.h"

using namespace manzana;

namespace {

constexpr int kWidth = 320, kHeight = 200;

/// Two threads of a host's.
class Pool {
 public:
  Pool() {
    for (std::thread& thread : threads_) thread = std::thread([this] { work(); });
  }
  ~Pool() {
    ending_ = true;
    for (std::thread& thread : threads_) thread.join();
  }
  void add(std::function<void()> task) {
    const std::scoped_lock lock(mutex_);
    tasks_.push_back(std::move(task));
  }
  bool owns(std::thread::id id) const {
    return std::any_of(threads_.begin(), threads_.end(), [&](const std::thread& t) { return t.get_id() == id; });
  }

 private:
  void work() {
    while (!ending_) {
      std::function<void()> task;
      {
        const std::scoped_lock lock(mutex_);
        if (!tasks_.empty()) task = std::move(tasks_.front()), tasks_.pop_front();
      }
      if (task)
        task();
      else
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  std::mutex mutex_;
  std::deque<std::function<void()>> tasks_;
  std::atomic<bool> ending_ = false;
  std::array<std::thread, 2> threads_;
};

/// From so high over the town that its trees are a few pixels.
HostCamera high_camera() { return looking({0, -900, 700}, {0, 0, 0}, kWidth, kHeight); }

/// On its main street.
HostCamera low_camera() { return looking({-4.6, -17.7, 1.7}, {100, 20, 8}, kWidth, kHeight); }

std::size_t threads_of_process() {
  const std::filesystem::directory_iterator all("/proc/self/task");
  return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

/// The same as a View draws it, of all that the frustum holds.
std::vector<Rgba> picture_of_all(const Model& model, const HostWindow& window, const HostCamera& host,
                                 std::size_t& buildings) {
  const Scene& scene = model.scene();
  draw::Renderer renderer(scene, model.plants(), draw::quality_for(gl::renderer_name()));
  const draw::Camera camera = draw::camera_of(host.projection, host.view, host.depth, kHeight);
  VisibleSets sets(scene);
  find_visible(scene, camera.frustum, Structure::bqr, sets);
  find_cars(scene, 0, sets);
  buildings = count(scene.buildings.table, sets.objects());
  draw::DrawOptions options;
  options.layers.sky = options.layers.fog = false;
  options.transparent = true;
  options.mosaics = false;
  renderer.resize({kWidth, kHeight});
  renderer.draw(scene, sets, camera, options);
  window.clear(0, 0, 0, 0);
  renderer.overlay({.viewport = host.viewport, .depth_scale = -1, .depth_offset = 1, .nearer_is_less = true});
  return window.pixels();
}

/// 1.7 m above the ground, on a grid about the middle, outside the boxes of buildings.
std::vector<Vec3d> places_between_houses(const Scene& scene, std::size_t n) {
  const Vec3d middle = (scene.bounds.min + scene.bounds.max) / 2.0;
  std::vector<Vec3d> places;
  for (int i = 0; places.size() < n; ++i) {
    const Vec2d at = Vec2d(middle) + 23.0 * Vec2d(i % 7 - 3, i / 7 - 3), in_tree = at - Vec2d(scene.tree.origin);
    const auto& boxes = scene.buildings.table.boxes;
    if (std::ranges::none_of(boxes, [&](const culling::Box& b) {
          return glm::all(glm::greaterThan(in_tree, Vec2d(b.min))) && glm::all(glm::lessThan(in_tree, Vec2d(b.max)));
        }))
      places.emplace_back(at, scene.frame.ground_z(at) + 1.7);
  }
  return places;
}

}  // namespace

TEST_CASE("view: far trees are made on the host's threads and a repaint is asked for when they are there") {
  const gl::HeadlessContext context;
  const HostWindow window(kWidth, kHeight);
  const auto main_thread = std::this_thread::get_id();
  Pool pool;
  std::atomic<int> tasks = 0, from_pool = 0, from_others = 0;
  const auto repaint = [&] {
    const auto id = std::this_thread::get_id();
    if (id != main_thread) ++(pool.owns(id) ? from_pool : from_others);
  };
  View view(
      {.request_repaint = repaint, .run = [&](std::function<void()> task) { ++tasks, pool.add(std::move(task)); }});
  view.show(town());
  const std::array<HostCamera, 1> camera{high_camera()};
  while (!view.update(camera, 0).shown) view.render(0);
  view.render(0);
  CHECK(view.update(camera, 0).far_trees_left > 0);
  const std::uint64_t bytes = view.update(camera, 0).gpu_bytes;
  const auto with = picture(view, window, camera[0]);
  CHECK(view.update(camera, 0).far_trees_left == 0);
  CHECK(view.update(camera, 0).gpu_bytes > bytes);
  CHECK(tasks > 0);
  CHECK(from_pool > 1);
  CHECK(from_others == 0);
  view.drawing().mosaics = view.drawing().groves = false;
  const auto without = picture(view, window, camera[0]);
  const double differs = share_different(with, without, 24);
  CHECK(share_different(with, without, 0) > 0.001);
  CHECK(differs < 0.2);  // of the same trees
  view.release();
}

TEST_CASE("view: tasks that outlast the view or its context do nothing") {
  const gl::HeadlessContext context;
  const HostWindow window(kWidth, kHeight);
  std::vector<std::function<void()>> tasks;
  int repaints = 0;
  {
    View view({.request_repaint = [&] { ++repaints; },
               .run = [&](std::function<void()> task) { tasks.push_back(std::move(task)); }});
    view.show(town());
    const std::array<HostCamera, 1> camera{high_camera()};
    window.bind();
    while (!view.update(camera, 0).shown) view.render(0);
    view.render(0);
    CHECK(view.update(camera, 0).far_trees_left > 0);
    view.release();
    CHECK(view.update(camera, 0).far_trees_left == 0);
  }
  REQUIRE_FALSE(tasks.empty());
  const int before = repaints;
  for (const auto& task : tasks) task();
  CHECK(repaints == before);
}

TEST_CASE("view: threads of its own are there only for far trees and end with release") {
  const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);  // TBB's are not counted
  const gl::HeadlessContext context;
  const HostWindow window(kWidth, kHeight);
  View view;
  view.show(town());
  view.drawing().mosaics = view.drawing().groves = false;
  picture(view, window, high_camera());
  const std::size_t before = threads_of_process();
  CHECK(view.update(std::array{high_camera()}, 0).far_trees_left == 0);
  view.drawing().mosaics = view.drawing().groves = true;
  view.render(0);
  CHECK(view.update(std::array{high_camera()}, 0).far_trees_left > 0);
  CHECK(threads_of_process() > before);
  view.release();
  CHECK(threads_of_process() == before);
  view.context_lost();
}

TEST_CASE("view: another context of the same city gets the far trees that there are") {
  View view;
  view.show(town());
  std::array<std::vector<Rgba>, 2> pictures;
  for (auto& one : pictures) {
    const gl::HeadlessContext context;
    const HostWindow window(kWidth, kHeight);
    one = picture(view, window, high_camera());
    view.release();
  }
  CHECK(share_different(pictures[0], pictures[1], 24) < 0.001);  // in the order that tasks ended
}

TEST_CASE("view: what stands behind buildings is left out and the picture is the same") {
  const gl::HeadlessContext context;
  const HostWindow window(kWidth, kHeight);
  HostCamera cut = low_camera();
  cut.projection = glm::perspective(glm::radians(60.0), 1.6, 40.0, 5000.0);  // without what is near
  HostCamera skewed = low_camera();
  skewed.projection[2][0] = 0.3;
  const std::vector<HostCamera> cameras{low_camera(), cut, skewed};
  View view;
  view.show(town());
  view.drawing().mosaics = false;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    std::size_t all = 0;
    const auto of_all = picture_of_all(*town(), window, cameras[i], all);
    const auto seen = picture(view, window, cameras[i]);
    const std::size_t left = view.update({&cameras[i], 1}, 0).cameras[0].buildings;
    CAPTURE(i, all, left);
    CHECK(share_different(of_all, seen, 2) < 1e-4);
    CHECK(left <= all);
    if (i != 1) CHECK(left < all / 2);
  }
  view.release();
}

TEST_CASE("view: of CityJSON too, from between the houses") {
  const auto file = data_file("citymodel/delft-bgt.city.json");
  if (!file) return;
  const auto delft = Model::load(file->string(), {.trees = false});
  const gl::HeadlessContext context;
  const HostWindow window(kWidth, kHeight);
  View view;
  view.show(delft);
  std::size_t all = 0, left = 0;
  for (const Vec3d& eye : places_between_houses(delft->scene(), 4)) {
    for (const Vec3d& way : {Vec3d(1, 0.3, 0), Vec3d(-0.5, 1, 0.05), Vec3d(0.2, -1, 0)}) {
      const HostCamera camera = looking(eye, eye + way, kWidth, kHeight);
      std::size_t in_frustum = 0;
      const auto of_all = picture_of_all(*delft, window, camera, in_frustum);
      const auto seen = picture(view, window, camera);
      CAPTURE(eye.x, eye.y, way.x);
      CHECK(share_different(of_all, seen, 2) < 1e-4);
      all += in_frustum;
      left += view.update({&camera, 1}, 0).cameras[0].buildings;
    }
  }
  CAPTURE(all, left);
  CHECK(left < all / 2);
  view.release();
}

TEST_CASE("view: buildings that are switched off hide nothing at once") {
  const gl::HeadlessContext context;
  const HostWindow window(kWidth, kHeight);
  View view;
  view.show(town());
  view.drawing().mosaics = false;
  picture(view, window, low_camera());
  view.drawing().layers.buildings = false;
  window.clear(0, 0, 0, 0);
  view.render(0);  // without an update
  while (view.update(std::array{low_camera()}, 0).bytes_to_upload > 0) view.render(0);
  window.clear(0, 0, 0, 0);
  view.render(0);
  const auto after = window.pixels();
  View another;
  another.show(town());
  another.drawing().mosaics = another.drawing().layers.buildings = false;
  CHECK(share_different(after, picture(another, window, low_camera()), 0) == 0);
  view.release();
  another.release();
}

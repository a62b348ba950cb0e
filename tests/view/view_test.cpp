// What a host asks of something that it embeds: ten points, a test each.
#include <atomic>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <thread>

#include "foliage/import/load_plant.h"
#include "tests/view/gl_mess.h"
#include "tests/view/host.h"

using namespace manzana;

namespace {

constexpr int kWidth = 320, kHeight = 200;

double share_covered(const std::vector<Rgba>& pixels) {
  std::size_t covered = 0;
  for (const Rgba& p : pixels) covered += p.c[3] > 0 ? 1 : 0;
  return static_cast<double>(covered) / static_cast<double>(pixels.size());
}

std::size_t threads_of_process() {
  std::size_t n = 0;
  for ([[maybe_unused]] const auto& task : std::filesystem::directory_iterator("/proc/self/task")) ++n;
  return n;
}

}  // namespace

TEST_CASE("view 1: the host owns the context: never drawn and released and lost and drawn in another one") {
  { View never; }
  std::vector<std::string> said;
  View view({.log = [&](const std::string& line) { said.push_back(line); }});
  view.release();
  view.show(town());
  std::vector<Rgba> first, second, third;
  {
    const gl::HeadlessContext context;
    const HostWindow window(kWidth, kHeight);
    first = picture(view, window, street_camera(kWidth, kHeight));
    view.release();
    second = picture(view, window, street_camera(kWidth, kHeight));
  }
  view.context_lost();
  {
    const gl::HeadlessContext another;
    const HostWindow window(kWidth, kHeight);
    third = picture(view, window, street_camera(kWidth, kHeight));
    view.release();
  }
  CHECK(share_covered(first) > 0.3);
  // Packs of far trees are numbered as they came, and of mosaics equally far the first is seen.
  CHECK(share_different(first, second, 2) < 1e-3);
  CHECK(share_different(first, third, 2) < 1e-3);
  CHECK(said.empty());
}

TEST_CASE("view 2: no state is relied on and all of it is put back and the bound framebuffer is drawn into") {
  const gl::HeadlessContext context;
  const HostWindow window(kWidth, kHeight), other(kWidth, kHeight);
  View view;
  view.show(town());
  const HostCamera camera = street_camera(kWidth, kHeight);
  const auto tidy = picture(view, window, camera);
  const gl::Buffer buffer = gl::make_buffer(std::size_t{64});
  other.clear(0, 0, 0, 0);
  leave_a_mess(buffer);
  const auto before = state_of_gl();
  view.render(0);
  CHECK(state_of_gl() == before);
  std::vector<FeatureId> ids(1);
  view.pick(0, {kWidth / 2, kHeight / 2, 1, 1}, ids);
  CHECK(state_of_gl() == before);
  glPixelStorei(GL_PACK_ROW_LENGTH, 0);
  CHECK(share_different(other.pixels(), tidy, 2) == 0);
  view.release();
}

TEST_CASE("view 3: loading and finding need no context") {
  View view;
  view.show(town());  // there is none in this process yet: a call of GL would end it
  const std::array<HostCamera, 1> cameras{street_camera(kWidth, kHeight)};
  CHECK_FALSE(view.update(cameras, 1).shown);
  view.show(nullptr);
  CHECK_FALSE(view.update(cameras, 2).shown);
}

TEST_CASE("view 4: cameras are matrices in double, several at once, skewed and orthographic") {
  const gl::HeadlessContext context;
  const HostWindow window(kWidth, kHeight);
  View view;
  view.show(town());
  const HostCamera plain = street_camera(kWidth, kHeight);
  bring_all(view, window, plain);
  HostCamera reversed = plain, skewed = plain, level = plain;
  reversed.depth = culling::ClipDepth::reversed;
  reversed.projection[2][2] = 0;
  reversed.projection[3][2] = 0.5;
  skewed.projection[2][0] = 0.3;
  const double scale = 100;
  level.projection = glm::ortho(-scale * 1.6, scale * 1.6, -scale, scale, 1.0, 2000.0);
  const std::vector<HostCamera> cameras{plain, reversed, skewed, level};
  view.update(cameras, 0);
  // Where a feature's place is by the host's own matrices, the feature is picked, or something before it.
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    int found = 0;
    for (FeatureId id = 1; id <= town()->features() && found < 40; ++id) {
      const Feature feature = town()->feature(id);
      if (feature.kind != kBuilding) continue;
      const Vec3d top((feature.box.min + feature.box.max) / 2.0);
      const glm::dvec4 clip =
          cameras[i].projection * cameras[i].view * glm::dvec4(top.x, top.y, feature.box.max.z - 0.5, 1);
      const Vec2d ndc = Vec2d(clip) / clip.w;
      if (clip.w <= 0 || std::abs(ndc.x) > 0.95 || std::abs(ndc.y) > 0.95) continue;
      std::vector<FeatureId> seen(1);
      view.pick(i, {static_cast<int>((ndc.x + 1) / 2 * kWidth), static_cast<int>((ndc.y + 1) / 2 * kHeight), 1, 1},
                seen);
      found += seen[0] == id ? 1 : 0;
    }
    INFO("camera " << i);
    CHECK(found >= 8);
  }
  window.clear(0, 0, 0, 0);
  view.render(0);
  const auto a = window.pixels();
  CHECK(share_covered(a) > 0.3);
  for (const std::size_t i : {std::size_t{2}, std::size_t{3}}) {
    window.clear(0, 0, 0, 0);
    view.render(i);
    const auto b = window.pixels();
    CHECK(share_covered(b) > 0.2);
    CHECK(share_different(a, b, 8) > 0.2);
  }
  view.release();
}

TEST_CASE("view 5: a host with earth-centred coordinates sees the same picture") {
  const gl::HeadlessContext context;
  const HostWindow window(kWidth, kHeight);
  View view;
  view.show(town());
  const HostCamera local = street_camera(kWidth, kHeight);
  const auto here = picture(view, window, local);
  HostCamera earth = local;
  const Mat4d to_ecef = town()->local_to_ecef();
  const Mat4d view_of_ecef = local.view * glm::inverse(to_ecef);  // what such a host has
  earth.view = view_of_ecef * to_ecef;                            // and what it hands over
  const auto there = picture(view, window, earth);
  CHECK(share_different(here, there, 8) < 0.01);
  view.release();
}

TEST_CASE("view 6: loading in two phases and what is new starts hidden and each frame uploads so much at most") {
  std::atomic<int> asked = 0;
  constexpr std::uint64_t kBytes = 200'000;
  View view({.request_repaint = [&] { ++asked; }}, {.upload_bytes_a_frame = kBytes});
  std::thread worker([&] { view.show(town()); });
  worker.join();
  CHECK(asked == 1);
  const gl::HeadlessContext context;
  const HostWindow window(kWidth, kHeight);
  const std::array<HostCamera, 1> cameras{street_camera(kWidth, kHeight)};
  std::uint64_t left = 0;
  int frames = 0;
  while (!view.update(cameras, 0).shown && ++frames < 10'000) {
    window.clear(0, 0, 0, 0);
    view.render(0);
    const std::uint64_t now = view.update(cameras, 0).bytes_to_upload;
    if (frames > 1) CHECK(left - now <= kBytes);
    left = now;
    CHECK(share_covered(window.pixels()) == 0);
  }
  CHECK(frames > 10);
  CHECK(asked >= frames);
  CHECK(share_covered(picture(view, window, cameras[0])) > 0.3);
  CHECK(view.complete());
  view.show(nullptr);
  CHECK_FALSE(view.complete());  // the last picture is not what comes
  view.release();
}

TEST_CASE("view 7: no threads of our own and files come from the host and views in several threads do not meet") {
  const std::size_t before = threads_of_process();
  std::ifstream file(MANZANA_VILLAGE, std::ios::binary);
  const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), {});
  const auto village =
      Model::load(bytes, "osm", "village", {.cars = 10, .plant_cache = foliage::default_cache_folder()});
  CHECK(threads_of_process() == before);
  CHECK(village->features() > 20);
  std::array<std::vector<Rgba>, 2> pictures;
  std::vector<std::thread> hosts;
  for (auto& out : pictures)
    hosts.emplace_back([&] {
      const gl::HeadlessContext context;
      const HostWindow window(kWidth, kHeight);
      View view;
      view.show(village);
      const culling::BoxD& box = village->scene().bounds;
      const Vec3d middle = (box.min + box.max) / 2.0;
      out = picture(view, window, looking(middle + Vec3d(0, -200, 150), middle, kWidth, kHeight));
      view.release();
    });
  for (std::thread& host : hosts) host.join();
  CHECK(share_covered(pictures[0]) > 0.2);
  CHECK(share_different(pictures[0], pictures[1], 2) == 0);
}

TEST_CASE("view 8: an update tells what will be drawn and what is held and a cap in bytes is kept") {
  const gl::HeadlessContext context;
  const HostWindow window(kWidth, kHeight);
  View view;
  view.show(town());
  const HostCamera street = street_camera(kWidth, kHeight);
  bring_all(view, window, street);
  HostCamera away = looking({0, 0, 500}, {0, 1, 900}, kWidth, kHeight);
  const std::array<HostCamera, 2> cameras{street, away};
  view.render(0);
  const Update& update = view.update(cameras, 0);
  REQUIRE(update.cameras.size() == 2);
  CHECK(update.cameras[0].buildings > 50);
  CHECK(update.cameras[0].trees > 20);
  CHECK(update.cameras[0].blocks > 5);
  CHECK(update.cameras[1].buildings == 0);
  CHECK(update.gpu_bytes > 1'000'000);
  CHECK(update.bytes_to_upload == 0);
  view.release();

  std::vector<std::string> said;
  View small({.log = [&](const std::string& line) { said.push_back(line); }}, {.gpu_bytes = 10'000});
  small.show(town());
  for (int frame = 0; frame < 5; ++frame) {
    window.clear(0, 0, 0, 0);
    CHECK_FALSE(small.update(cameras, 0).shown);
    small.render(0);
  }
  REQUIRE(said.size() == 1);
  CHECK(said[0].find("10000 are allowed") != std::string::npos);
  small.release();
  CHECK(view.update(cameras, 0).gpu_bytes == 0);
}

TEST_CASE("view 9: what is picked has a number and a kind and a place") {
  const gl::HeadlessContext context;
  const HostWindow window(kWidth, kHeight);
  View view;
  view.show(town());
  const HostCamera camera = street_camera(kWidth, kHeight);
  const auto seen = picture(view, window, camera);
  std::vector<FeatureId> ids(static_cast<std::size_t>(kWidth * kHeight));
  view.pick(0, {0, 0, kWidth, kHeight}, ids);
  std::size_t both = 0, either = 0;
  std::array<int, 9> kinds{};
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const bool drawn = seen[i].c[3] > 0, picked = ids[i] != 0;
    both += drawn && picked ? 1 : 0;
    either += drawn || picked ? 1 : 0;
    if (picked) ++kinds[town()->feature(ids[i]).kind];
  }
  CHECK(static_cast<double>(both) > 0.93 * static_cast<double>(either));
  CHECK(kinds[kBuilding] > 100);
  CHECK(kinds[kSurface] > 100);
  CHECK(kinds[kTree] > 100);
  const FeatureId one = ids[static_cast<std::size_t>(kWidth * (kHeight / 4) + kWidth / 2)];
  REQUIRE(one != 0);
  std::vector<FeatureId> again(1);
  view.pick(0, {kWidth / 2, kHeight / 4, 1, 1}, again);
  CHECK(again[0] == one);
  const Feature feature = town()->feature(one);
  CHECK(feature.id == one);
  view.render(0);
  const auto place = view.place(0, kWidth / 2, kHeight / 4);
  REQUIRE(place);
  CHECK(glm::all(glm::greaterThan(*place, feature.box.min - 0.05)));
  CHECK(glm::all(glm::lessThan(*place, feature.box.max + 0.05)));
  CHECK_FALSE(view.place(0, kWidth / 2, kHeight - 1));  // the sky
  CHECK(std::abs(feature.place.lat_deg - town()->frame().anchor().lat_deg) < 0.05);
  CHECK_THROWS_AS(town()->feature(0), std::out_of_range);
  CHECK_THROWS_AS(town()->feature(town()->features() + 1), std::out_of_range);
  view.release();
}

TEST_CASE("view 10: depth is the host's too and alpha is premultiplied") {
  const gl::HeadlessContext context;
  const HostWindow window(kWidth, kHeight);
  View view;
  view.show(town());
  const HostCamera camera = street_camera(kWidth, kHeight);
  const auto alone = picture(view, window, camera);
  for (const Rgba& p : alone)
    for (std::size_t k = 0; k < 3; ++k) REQUIRE(p.c[k] <= p.c[3] + 1);
  // What stands where a feature is picked has the depth that the host's matrices give it.
  std::vector<FeatureId> ids(static_cast<std::size_t>(kWidth * kHeight));
  view.pick(0, {0, 0, kWidth, kHeight}, ids);
  int inside = 0, checked = 0;
  for (int x = 8; x < kWidth; x += 16) {
    const FeatureId id = ids[static_cast<std::size_t>(kWidth * (kHeight / 3) + x)];
    const Feature feature = town()->feature(std::max(id, 1U));
    if (id == 0 || feature.kind == kTree) continue;
    double nearest = 1, farthest = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3d p((corner & 1) != 0 ? feature.box.min.x : feature.box.max.x,
                    (corner & 2) != 0 ? feature.box.min.y : feature.box.max.y,
                    (corner & 4) != 0 ? feature.box.min.z : feature.box.max.z);
      const glm::dvec4 clip = camera.projection * camera.view * glm::dvec4(p, 1);
      const double depth = (clip.z / clip.w + 1) / 2;
      nearest = std::min(nearest, depth);
      farthest = std::max(farthest, depth);
    }
    const auto depth = static_cast<double>(window.depth_at(x, kHeight / 3));
    ++checked;
    inside += depth >= nearest - 1e-5 && depth <= farthest + 1e-5 ? 1 : 0;
  }
  CHECK(checked > 5);
  CHECK(inside >= checked - 1);  // a tree may stand before it that is seen through where it is picked
  // Before everything, the host's stays; behind everything, ours is over it.
  window.clear(0, 0, 0, 0);
  window.fill({1, 0, 0, 1}, 0.0001F);
  view.render(0);
  CHECK(window.pixels()[0] == Rgba{{255, 0, 0, 255}});
  CHECK(share_different(window.pixels(), std::vector<Rgba>(alone.size(), Rgba{{255, 0, 0, 255}}), 0) == 0);
  window.clear(0, 0, 0, 0);
  window.fill({0, 0, 1, 1}, 0.999999F);
  view.render(0);
  const auto over = window.pixels();
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < over.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      wrong += std::abs(over[i].c[k] - (alone[i].c[k] + (k == 2 ? 255 - alone[i].c[3] : 0))) > 2 ? 1 : 0;
  CHECK(wrong == 0);
  view.release();
}

TEST_CASE("view: what cannot be shown is told once and dropped") {
  const gl::HeadlessContext context;
  const HostWindow window(kWidth, kHeight);
  View view({}, {.quality = "medium"});
  const std::array<HostCamera, 1> cameras{street_camera(kWidth, kHeight)};
  for (int attempt = 0; attempt < 2; ++attempt) {
    view.show(town());
    view.update(cameras, 0);
    window.bind();
    CHECK_THROWS_AS(view.render(0), std::invalid_argument);
    CHECK_NOTHROW(view.render(0));
    CHECK_FALSE(view.update(cameras, 0).shown);
  }
  view.release();
}

// What a host puts into a shown city: drawn where it stands, picked, moved, painted, hidden; the rest unharmed.
#include <catch2/catch.hpp>

#include "tests/view/host.h"

using namespace manzana;

namespace {

constexpr int kWidth = 320, kHeight = 200;

/// A white box on the ground, normals outward.
std::shared_ptr<const NodeMesh> box_mesh(const Vec3& half) {
  auto mesh = std::make_shared<NodeMesh>();
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0F, 1.0F}) {
      Vec3 normal(0), u(0), v(0);
      normal[axis] = side;
      u[(axis + 1) % 3] = 1;
      v[(axis + 2) % 3] = 1;
      const auto base = static_cast<std::uint32_t>(mesh->vertices.size());
      for (const Vec3& corner : {normal - u - v, normal + u - v, normal + u + v, normal - u + v})
        mesh->vertices.push_back({corner * half + Vec3(0, 0, half.z), pack_normal(normal), 0xFFFFFF});
      for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) mesh->indices.push_back(base + i);
    }
  return mesh;
}

/// Where a point of L is in the picture.
std::size_t pixel_of(const HostCamera& camera, const Vec3d& p) {
  const glm::dvec4 clip = camera.projection * camera.view * glm::dvec4(p, 1);
  const auto x = static_cast<std::size_t>((clip.x / clip.w + 1) / 2 * kWidth);
  const auto y = static_cast<std::size_t>((clip.y / clip.w + 1) / 2 * kHeight);
  return y * kWidth + x;
}

std::size_t picked(View& view, const std::vector<FeatureId>& ids, FeatureId id) {
  std::vector<FeatureId> now(ids.size());
  view.pick(0, {0, 0, kWidth, kHeight}, now);
  return static_cast<std::size_t>(std::count(now.begin(), now.end(), id));
}

}  // namespace

TEST_CASE("nodes: appear where they stand and move and are painted and disappear") {
  const gl::HeadlessContext context;
  const HostWindow window(kWidth, kHeight);
  const HostCamera camera = street_camera(kWidth, kHeight);
  const auto nodes = town()->new_nodes();
  View view;
  view.show(town());
  const auto before = picture(view, window, camera);
  view.show(town(), nodes);  // nothing of the city is brought anew
  CHECK(view.update(std::array{camera}, 0).shown);
  CHECK(share_different(picture(view, window, camera), before, 0) == 0);

  const std::vector<FeatureId> all(kWidth * kHeight);
  const Vec3d here(0, -240, 30), there(30, -220, 30);
  const NodeId layer = nodes->add({.name = "planned"});
  const NodeId house =
      nodes->add({.parent = layer, .placement = upright(town()->frame(), here), .mesh = box_mesh({8, 8, 8})});
  const auto at_here = picture(view, window, camera);
  const std::size_t mid = pixel_of(camera, here + Vec3d(0, 0, 8));
  CHECK(at_here[mid].c[3] == 255);
  CHECK(at_here[mid] != before[mid]);
  CHECK(view.update(std::array{camera}, 0).cameras[0].nodes == 1);
  std::vector<FeatureId> ids(kWidth * kHeight);
  view.pick(0, {0, 0, kWidth, kHeight}, ids);
  CHECK(ids[mid] == house);
  const auto place = view.place(0, static_cast<int>(mid % kWidth), static_cast<int>(mid / kWidth));
  REQUIRE(place);
  CHECK(glm::all(glm::greaterThan(*place, nodes->box(house).min - 0.1)));
  CHECK(glm::all(glm::lessThan(*place, nodes->box(house).max + 0.1)));
  for (std::size_t i = 0; i < ids.size(); ++i)  // elsewhere the picture is what it was, but at the node's own edge
    if (ids[i] != house && (i == 0 || ids[i - 1] != house) && (i + 1 == ids.size() || ids[i + 1] != house) &&
        (i < kWidth || ids[i - kWidth] != house) && (i + kWidth >= ids.size() || ids[i + kWidth] != house))
      REQUIRE(at_here[i] == before[i]);

  nodes->move(house, upright(town()->frame(), there));
  const auto at_there = picture(view, window, camera);
  CHECK(at_there[mid] == before[mid]);
  CHECK(at_there[pixel_of(camera, there + Vec3d(0, 0, 8))] != before[pixel_of(camera, there + Vec3d(0, 0, 8))]);

  nodes->paint(layer, 0x2040ff);
  const auto blue = picture(view, window, camera)[pixel_of(camera, there + Vec3d(0, 0, 8))];
  CHECK((blue.c[2] > 2 * blue.c[0] && blue.c[2] > blue.c[1]));

  nodes->show(layer, false);
  CHECK(share_different(picture(view, window, camera), before, 0) == 0);
  CHECK(picked(view, all, house) == 0);
  nodes->show(layer, true);
  CHECK(picture(view, window, camera) != before);
  nodes->remove(layer);
  CHECK(share_different(picture(view, window, camera), before, 0) == 0);
  view.release();
}

TEST_CASE("view: buildings are coloured by what is said of them and in their own colours again") {
  const gl::HeadlessContext context;
  const HostWindow window(kWidth, kHeight);
  const auto village = Model::load(MANZANA_VILLAGE, {.cars = 0, .trees = false});
  const culling::BoxD& box = village->scene().bounds;
  const HostCamera camera = looking({center(box).x, box.min.y - 20, 80}, center(box), kWidth, kHeight);
  View view;
  view.show(village);
  const auto own = picture(view, window, camera);
  std::size_t asked = 0;
  view.colour_by([&](const Feature& feature) {
    ++asked;
    return feature.attributes.find("building") == "church" ? View::Colour() : View::Colour(0x1010ff);
  });
  const auto blue = picture(view, window, camera);
  CHECK(asked == village->scene().buildings.table.size());
  std::vector<FeatureId> ids(kWidth * kHeight);
  view.pick(0, {0, 0, kWidth, kHeight}, ids);
  std::size_t walls = 0, bluer = 0, unharmed = 0, others = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const bool wall = ids[i] != 0 && village->feature(ids[i]).kind == kBuilding;
    walls += wall ? 1 : 0;
    bluer += wall && blue[i].c[2] > blue[i].c[0] + 20 ? 1 : 0;
    others += wall ? 0 : 1;
    unharmed += !wall && blue[i] == own[i] ? 1 : 0;
  }
  CHECK(walls > 500);
  CHECK(static_cast<double>(bluer) > 0.7 * static_cast<double>(walls));
  CHECK(static_cast<double>(unharmed) > 0.95 * static_cast<double>(others));  // all but the edges of walls
  view.colour_by({});
  CHECK(share_different(picture(view, window, camera), own, 0) == 0);
  view.release();
}

TEST_CASE("nodes: a picture does not tell in what order things were done") {
  const gl::HeadlessContext context;
  const HostWindow window(kWidth, kHeight);
  const HostCamera camera = street_camera(kWidth, kHeight);
  const auto mesh = box_mesh({6, 6, 6});
  const auto pictured = [&](bool busy) {
    const auto nodes = town()->new_nodes();
    const NodeId a =
        nodes->add({.placement = upright(town()->frame(), {0, -240, 30}), .mesh = mesh, .colour = 0xff0000});
    const NodeId b =
        nodes->add({.placement = upright(town()->frame(), {3, -240, 30}), .mesh = mesh, .colour = 0x00ff00});
    for (int i = 0; busy && i < 50; ++i) {
      const Mat4d home = nodes->placement(i % 2 == 0 ? a : b);
      nodes->move(i % 2 == 0 ? a : b, upright(town()->frame(), {40.0 * i, 100, 0}));
      nodes->move(i % 2 == 0 ? a : b, home);
    }
    View view;
    view.show(town(), nodes);
    auto result = picture(view, window, camera);
    view.release();
    return result;
  };
  CHECK(pictured(false) == pictured(true));
}

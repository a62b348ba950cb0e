// What a host puts into a city: found as if the tree had been built from all of it, and never lost; the city unharmed.
#include "scenegraph/nodes.h"

#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <iostream>
#include <map>
#include <set>

#include "culling/baselines/exact.h"
#include "scenegraph/import/import.h"
#include "scenegraph/visible.h"
#include "tests/support/random.h"

using namespace manzana;
using culling::BoxD;

namespace {

const Scene& town() {
  static const Imported city = import_city("builtin:town", {.cars = 50}, {});
  return city.scene;
}

std::shared_ptr<const NodeMesh> block_mesh(const Vec3& half) {
  auto mesh = std::make_shared<NodeMesh>();
  for (const float x : {-half.x, half.x})
    for (const float y : {-half.y, half.y})
      for (const float z : {0.0F, 2 * half.z}) mesh->vertices.push_back({{x, y, z}, 0, 0xFFFFFF});
  mesh->indices = {0, 1, 2, 3, 4, 5};
  return mesh;
}

Vec3d any_place(support::Random& random) {
  const Vec3d size = town().bounds.max - town().bounds.min;
  const double far = random.unit() < 0.05 ? 100 : 1.2;
  return center(town().bounds) + size * far * Vec3d(random.within(-0.5, 0.5), random.within(-0.5, 0.5), 0);
}

Mat4d any_placement(support::Random& random, bool below) {
  Mat4d m = upright(town().frame, below ? Vec3d(0) : any_place(random), random.within(-3, 3));
  if (below) m[3] = glm::dvec4(random.within(-30, 30), random.within(-30, 30), random.within(0, 30), 1);
  if (random.unit() < 0.2) m[0] *= -random.within(0.2, 3);
  return m;
}

/// A plain list of the same, beside the nodes.
struct Listed {
  NodeId parent = 0;
  Mat4d placement{1};
  std::shared_ptr<const NodeMesh> mesh;
  bool shown = true;
};
struct Host {
  Nodes nodes{town()};
  std::map<NodeId, Listed> list;
  std::vector<std::shared_ptr<const NodeMesh>> meshes{block_mesh({1, 1, 1}), block_mesh({20, 5, 12}), nullptr};

  NodeId any(support::Random& random) const {
    return std::next(list.begin(), random.below(static_cast<int>(list.size())))->first;
  }
  void add(support::Random& random) {
    const NodeId parent = !list.empty() && random.unit() < 0.5 ? any(random) : 0;
    const Listed l{parent, any_placement(random, parent != 0), meshes[static_cast<std::size_t>(random.below(3))],
                   random.unit() < 0.8};
    list[nodes.add({.parent = l.parent, .placement = l.placement, .mesh = l.mesh, .shown = l.shown})] = l;
  }
  bool is_below(NodeId id, NodeId above) const {
    for (; id != 0; id = list.at(id).parent)
      if (id == above) return true;
    return false;
  }
  void remove(NodeId id) {
    std::vector<NodeId> gone;
    for (const auto& [other, listed] : list)
      if (is_below(other, id)) gone.push_back(other);
    nodes.remove(id);
    for (const NodeId other : gone) list.erase(other);
  }
  void edit(support::Random& random) {
    const double what = random.unit();
    if (list.empty() || what < 0.3) return add(random);
    const NodeId id = any(random);
    if (what < 0.4) return remove(id);
    Listed& l = list[id];
    if (what < 0.8) {
      nodes.move(id, l.placement = any_placement(random, l.parent != 0));
    } else if (what < 0.9) {
      nodes.show(id, l.shown = !l.shown);
    } else {
      const NodeId to = any(random);
      if (is_below(to, id)) {
        CHECK_THROWS_AS(nodes.hang(id, to), std::invalid_argument);
      } else {
        nodes.hang(id, l.parent = to);
      }
    }
  }
  bool shows(NodeId id) const {
    for (; id != 0; id = list.at(id).parent)
      if (!list.at(id).shown) return false;
    return true;
  }
  /// All vertices, where they are.
  BoxD box(NodeId id) const {
    Mat4d m(1);
    for (NodeId at = id; at != 0; at = list.at(at).parent) m = list.at(at).placement * m;
    BoxD box;
    if (list.at(id).mesh)
      for (const NodeVertex& v : list.at(id).mesh->vertices)
        box = merge(box, Vec3d(m * glm::dvec4(Vec3d(v.position), 1)));
    return box;
  }
};

culling::View any_view(support::Random& random) {
  const double a = random.within(0, 6.2832);
  return culling::look(any_place(random) + Vec3d(0, 0, random.within(1, 200)),
                       {std::cos(a), std::sin(a), random.within(-1, 0.3)}, {0, 0, 1}, random.within(0.2, 1.5), 1.6);
}

std::set<NodeId> found(const Nodes& nodes, VisibleSets& sets, const culling::View& view) {
  find_visible(nodes, make_frustum(view), sets);
  std::vector<SeenNode> seen;
  nodes.find(sets.nodes(), seen);
  std::set<NodeId> ids;
  for (const SeenNode& node : seen) REQUIRE(ids.insert(node.id).second);
  return ids;
}

/// One node for each that shows, put in anew.
std::set<NodeId> found_anew(const Host& host, const culling::View& view) {
  Nodes anew(town());
  std::map<NodeId, NodeId> was;
  for (const auto& [id, listed] : host.list)
    if (listed.mesh && host.shows(id)) was[anew.add({.placement = host.nodes.placement(id), .mesh = listed.mesh})] = id;
  VisibleSets sets(town());
  std::set<NodeId> ids;
  for (const NodeId id : found(anew, sets, view)) ids.insert(was.at(id));
  return ids;
}

/// Nothing of the city is lost, nothing that is gone or hidden is found, and no node that is seen is missing.
void check(const Host& host, VisibleSets& sets, const culling::View& view) {
  const std::set<NodeId> ids = found(host.nodes, sets, view);
  const culling::ExactView exact = culling::make_exact(view);
  for (const auto& [id, listed] : host.list) {
    const bool there = listed.mesh && host.shows(id);
    if (ids.contains(id)) REQUIRE(there);
    if (there && !ids.contains(id)) REQUIRE_FALSE(exactly_overlaps(exact, host.box(id)));
  }
  for (const NodeId id : ids) REQUIRE(host.list.contains(id));
  VisibleSets plain(town());
  find_visible(town(), view, Structure::bqr, plain);
  const auto all = [](const VisibleSets& of) { return std::vector(of.objects().begin(), of.objects().end()); };
  REQUIRE(all(sets) == all(plain));
  std::set<std::uint32_t> blocks, plain_blocks;
  for (const auto& run : sets.blocks())
    for (std::uint32_t b = run.first; b < run.last; ++b) blocks.insert(b);
  for (const auto& run : plain.blocks())
    for (std::uint32_t b = run.first; b < run.last; ++b) plain_blocks.insert(b);
  REQUIRE(blocks == plain_blocks);
}

}  // namespace

TEST_CASE("nodes: after any edits what is seen is found and nothing else changes") {
  for (const std::uint64_t seed : {1, 2, 3}) {
    support::Random random(seed);
    Host host;
    VisibleSets sets(town());
    std::size_t seen = 0;
    for (int i = 0; i < 600; ++i) {
      host.edit(random);
      REQUIRE(host.nodes.size() == host.list.size());
      if (i % 2 != 0) continue;
      const culling::View view = any_view(random);
      check(host, sets, view);
      seen += found(host.nodes, sets, view).size();
    }
    CHECK(seen > 200);
    std::size_t edited = 0, anew = 0;
    for (int i = 0; i < 50; ++i) {
      const culling::View view = any_view(random);
      edited += found(host.nodes, sets, view).size();
      anew += found_anew(host, view).size();
    }
    CHECK(static_cast<double>(edited) == Approx(static_cast<double>(anew)).epsilon(0.03).margin(3));
  }
}

TEST_CASE("nodes: what holds for a node holds for all below") {
  Nodes nodes(town());
  const auto mesh = block_mesh({1, 1, 1});
  const NodeId layer = nodes.add({.name = "planned"}), house = nodes.add({.parent = layer, .mesh = mesh}),
               roof = nodes.add({.parent = house, .mesh = mesh, .colour = 0x112233});
  CHECK(layer == town().tree.objects() + 1);
  CHECK(nodes.visible(roof));
  nodes.show(layer, false);
  CHECK_FALSE(nodes.visible(roof));
  CHECK(nodes.node(roof).shown);
  nodes.show(layer, true);
  Mat4d east(1);
  east[3].x = 100;
  nodes.move(house, east);
  CHECK(nodes.placement(roof)[3].x == 100);
  CHECK(nodes.box(layer).min.x == 99);
  nodes.paint(layer, 0xff0000);
  VisibleSets sets(town());
  std::vector<SeenNode> seen;
  find_visible(nodes, make_frustum(culling::look({100, 0, 50}, {0, 0, -1}, {0, 1, 0}, 1, 1)), sets);
  nodes.find(sets.nodes(), seen);
  REQUIRE(seen.size() == 2);
  CHECK(seen[0].colour == 0xff0000U);
  CHECK(seen[1].colour == 0x112233U);
  CHECK(seen[0].mesh == seen[1].mesh);
  nodes.remove(house);
  CHECK_FALSE(nodes.contains(roof));
  CHECK(nodes.contains(layer));
  CHECK(nodes.children(layer).empty());
  CHECK(nodes.add({}) > roof);
}

TEST_CASE("nodes: a host has classes of its own") {
  support::Random random(5);
  Nodes nodes(town());
  const NodeId node = nodes.add({.placement = any_placement(random, false), .mesh = block_mesh({5, 5, 5})});
  const auto of = [](std::uint32_t object) { return static_cast<culling::ClassMask>(1U << (object % 3)); };
  nodes.classify(of);
  VisibleSets all(town()), some(town());
  std::size_t asked = 0, cars = 0;
  for (int i = 0; i < 60; ++i) {
    const culling::View view = any_view(random);
    some.classes = static_cast<culling::ClassMask>(1U << (i % 5));  // of the host's, cars, nodes
    find_visible(nodes, make_frustum(view), all);
    find_visible(nodes, make_frustum(view), some);
    std::set<std::uint32_t> wanted, found;
    for (const auto& run : all.objects())
      for (std::uint32_t o = run.first; o < run.last; ++o)
        if ((of(o) & some.classes) != 0) wanted.insert(o);
    for (const auto& run : some.objects())
      for (std::uint32_t o = run.first; o < run.last; ++o) found.insert(o);
    REQUIRE(found == wanted);
    REQUIRE(some.nodes().size() == ((some.classes & kNode) != 0 ? all.nodes().size() : 0));
    asked += found.size();
    find_cars(town(), 0, all);
    find_cars(town(), 0, some);
    REQUIRE(some.cars.size() == ((some.classes & kCar) != 0 ? all.cars.size() : 0));
    cars += some.cars.size();
  }
  CHECK(asked > 500);
  CHECK(cars > 0);
  CHECK(nodes.contains(node));
}

TEST_CASE("nodes: what is wrong is refused and nothing has changed") {
  Nodes nodes(town());
  const NodeId one = nodes.add({.mesh = block_mesh({1, 1, 1})});
  Mat4d skew(1), far(1), nan(1);
  skew[0][3] = 1;
  far[3].x = 1e10;
  nan[1][1] = std::nan("");
  for (const Mat4d& bad : {skew, far, nan}) {
    CHECK_THROWS_AS(nodes.move(one, bad), std::invalid_argument);
    CHECK_THROWS_AS(nodes.add({.placement = bad}), std::invalid_argument);
  }
  NodeMesh mesh = *block_mesh({1, 1, 1});
  mesh.indices.push_back(8);
  CHECK_THROWS_AS(nodes.add({.mesh = std::make_shared<NodeMesh>(mesh)}), std::invalid_argument);
  for (const NodeId none : {NodeId{0}, NodeId{1}, one + 1, ~NodeId{0}}) {
    CHECK_THROWS_AS(nodes.move(none, Mat4d(1)), std::invalid_argument);
    CHECK_THROWS_AS(nodes.remove(none), std::invalid_argument);
    CHECK_FALSE(nodes.contains(none));
  }
  CHECK_THROWS_AS(nodes.add({.parent = one + 1}), std::invalid_argument);
  CHECK(nodes.size() == 1);
  CHECK(nodes.placement(one) == Mat4d(1));
}

TEST_CASE("nodes: a scene of nothing can hold them") {
  const Scene empty;
  Nodes nodes(empty);
  const NodeId one = nodes.add({.mesh = block_mesh({1, 1, 1})});
  VisibleSets sets(empty);
  CHECK(found(nodes, sets, culling::look({0, -30, 5}, {0, 1, 0}, {0, 0, 1}, 1, 1)) == std::set{one});
  CHECK((sets.objects().empty() && sets.blocks().empty()));
}

TEST_CASE("nodes: a thousand moves a frame take no memory") {
  support::Random random(9);
  Nodes nodes(town());
  const auto mesh = block_mesh({2, 1, 1});
  std::vector<NodeId> ids;
  for (int i = 0; i < 1000; ++i) ids.push_back(nodes.add({.placement = any_placement(random, false), .mesh = mesh}));
  std::vector<double> ms;
  std::size_t before = 0;
  for (int frame = 0; frame < 60; ++frame) {
    std::vector<Mat4d> to;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      to.push_back(nodes.placement(ids[i]));
      to.back()[3].x += random.within(-1, 1);
    }
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < ids.size(); ++i) nodes.move(ids[i], to[i]);
    ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    if (frame == 10) before = nodes.tree().nodes.size() + nodes.tree().packets.size() + nodes.tree().objects();
  }
  std::sort(ms.begin(), ms.end());
  std::cout << "a thousand moves: " << ms[0] << " ms at best, " << ms[30] << " ms in the median\n";
  CHECK(nodes.tree().nodes.size() + nodes.tree().packets.size() + nodes.tree().objects() <= before + 4);
}

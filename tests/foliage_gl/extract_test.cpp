// The GPU's selection against the CPU's, to the bit.
#include <catch2/catch.hpp>
#include <cstring>

#include "foliage/budget.h"
#include "foliage/detail.h"
#include "foliage/generate.h"
#include "foliage/gl/extract.h"
#include "foliage/import/species.h"
#include "foliage/prepare.h"
#include "foliage/random.h"
#include "gl/context.h"
#include "gl/error_log.h"
#include "tests/foliage/tiny_plants.h"
#include "tests/support/random.h"

namespace manzana::foliage {
namespace {

const std::vector<PreparedPlant>& plants() {
  static const std::vector<PreparedPlant> all = [] {
    std::vector<PreparedPlant> made;
    for (const char* name : {"broadleaf", "conifer", "shrub"}) {
      PreparedPlant& plant = made.emplace_back(prepare(grow_plant(builtin_species(name), 7), {.quads_per_cell = 100}));
      plant.visibility.side = 2 + static_cast<std::uint32_t>(made.size());  // of whatever: both must read the same
      const std::size_t directions = plant.visibility.side * plant.visibility.side;
      for (std::size_t i = 0; i < plant.cells.size() * directions; ++i)
        plant.visibility.share.push_back(static_cast<std::uint8_t>(hash(i)));
    }
    made.push_back(prepare(leaves_on_ground(400, 0.01F, 1), {.quads_per_cell = 100}));  // thin: lines
    return made;
  }();
  return all;
}

struct Forest {
  std::vector<TreeSite> sites;
  std::vector<Vec4> rows;  // of the blocks
  std::vector<Run> runs;
};

/// Trees near and far, in blocks turned and moved; every other run of them in view.
Forest make_forest(std::uint32_t trees, std::uint64_t seed) {
  constexpr std::uint32_t kBlocks = 9;
  support::Random random(seed);
  Forest forest;
  for (std::uint32_t b = 0; b < kBlocks; ++b) {
    const auto angle = static_cast<float>(random.within(-3, 3));
    const auto x = static_cast<float>(random.within(-300, 300)), y = static_cast<float>(random.within(-300, 300));
    forest.rows.push_back({std::cos(angle), -std::sin(angle), 0, x});
    forest.rows.push_back({std::sin(angle), std::cos(angle), 0, y});
    forest.rows.push_back({0, 0, 1, -1.7F});
  }
  for (std::uint32_t i = 0; i < trees; ++i) {
    const auto kind = static_cast<std::uint32_t>(random.within(0, 3));
    const auto height = static_cast<float>(random.within(1, 30)), radius = static_cast<float>(random.within(0.5, 8));
    const double far = std::exp(random.within(0, 9)), yaw = random.within(-7, 7);
    TreeSite site = make_site(plants()[kind], kind, height, radius, static_cast<float>(yaw), seed + i);
    site.position = {static_cast<float>(far * std::cos(yaw)), static_cast<float>(far * std::sin(3 * yaw)), 0};
    site.block = static_cast<std::uint32_t>(random.within(0, kBlocks));
    for (std::uint32_t a = 0; a < glsl::kLeewayAzimuths; ++a)  // of whatever, likewise
      site.leeway[a] = static_cast<std::uint32_t>(hash(seed + i, a));
    forest.sites.push_back(site);
  }
  for (std::uint32_t first = 0; first < trees;) {
    const std::uint32_t last = std::min(trees, first + 1 + static_cast<std::uint32_t>(random.within(0, 40)));
    forest.runs.push_back({first, last});
    first = last + static_cast<std::uint32_t>(random.within(0, 20));
  }
  return forest;
}

template <class T>
std::vector<T> read(const gl::Buffer& buffer, std::size_t n) {
  std::vector<T> values(n);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(buffer.name(), 0, static_cast<GLsizeiptr>(n * sizeof(T)), values.data());
  return values;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// What `extract` is told of the forest; the buffers live as long as this.
struct Uploaded {
  gl::Buffer rows, sites;
  TreesInView view;
};

Uploaded upload(const Forest& forest) {
  std::vector<std::uint32_t> sites;
  Uploaded up;
  for (const Run& run : forest.runs)
    for (std::uint32_t site = run.first; site < run.last; ++site) sites.push_back(site);
  up.rows = gl::make_buffer(std::as_bytes(std::span(forest.rows)));
  up.sites = gl::make_buffer(std::as_bytes(std::span(sites)));
  up.view.buffer = up.sites.name();
  up.view.trees = static_cast<std::uint32_t>(sites.size());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kBlockRowsBinding, up.rows.name());
  return up;
}

std::uint32_t items_of(const glsl::Totals& totals) {
  return totals.all_trees * glsl::kFixedItems + totals.cells_before + totals.cells;
}

/// The primitives that the groups of a list name, each as (item, rank), in order.
std::vector<glm::uvec2> expand(const std::vector<glm::uvec2>& groups, std::size_t first, std::size_t last,
                               std::uint32_t size, const std::vector<Item>& items) {
  std::vector<glm::uvec2> all;
  for (std::size_t g = first; g < last; ++g)
    for (std::uint32_t rank = groups[g].y; rank < std::min(groups[g].y + size, items[groups[g].x].count); ++rank)
      all.emplace_back(groups[g].x, rank);
  return all;
}

}  // namespace

TEST_CASE("the GPU chooses what its twin on the CPU does to the bit") {
  const gl::HeadlessContext context;
  gl::ErrorLog log;
  PlantStore store(plants());
  const auto trees = GENERATE(1U, 63U, 1500U);
  const auto law = GENERATE(from_range(all_laws().begin(), all_laws().end()));
  const auto error_px = GENERATE(0.4, 1.0, 5.0);
  const std::uint64_t seed = trees + static_cast<std::uint64_t>(error_px * 10);
  INFO("trees " << trees << " law " << name_of(law) << " error " << error_px << " seed " << seed);
  const Forest forest = make_forest(trees, seed);
  set_details(store, make_details(plants(), law));
  Selection expected;
  const double error_at_1m = error_px / 700;
  TreesSeen seen{forest.sites, forest.rows, forest.runs, error_at_1m};
  const culling::View view = culling::look({0, 0, 0}, {1, .3, -.1}, {0, 0, 1}, 0.8, 1.5);
  if (GENERATE(false, true)) seen.sides = sides_of(culling::make_frustum(view), view.eye);
  select(store.table, seen, expected);

  Extractor extractor(forest.sites, {});
  Uploaded up = upload(forest);
  up.view.error_at_1m = error_at_1m;
  up.view.sides = seen.sides;
  extract(extractor, store, up.view);
  REQUIRE(up.view.trees == expected.trees.size());
  CHECK(same_bits(read<TreeRecord>(extractor.trees, expected.trees.size()), expected.trees));
  const auto totals = read<glsl::Totals>(extractor.totals, 1).front();
  REQUIRE(items_of(totals) == expected.items.size());
  const auto items = read<Item>(extractor.items, expected.items.size());
  CHECK(same_bits(items, expected.items));

  glFinish();
  const Shown shown = newest_shown(extractor), counted = count_shown(expected);
  CHECK(shown.bark == counted.bark);
  CHECK(shown.leaves == counted.leaves);
  CHECK(shown.lines == counted.lines);
  CHECK(shown.points == counted.points);
  const auto groups = read<glm::uvec2>(extractor.groups, extractor.capacity.quad_groups + totals.groups.y);
  const auto quads =
      expand(groups, 0, std::min(totals.groups.x, extractor.capacity.quad_groups), glsl::kQuadGroup, items);
  std::vector<glm::uvec2> wanted;
  for (std::uint32_t i = 0; i < items.size(); ++i)
    for (std::uint32_t rank = 0; items[i].kind <= glsl::kLeaves && rank < items[i].count; ++rank)
      wanted.emplace_back(i, rank);
  const std::size_t most = std::size_t{extractor.capacity.quad_groups} * glsl::kQuadGroup;
  if (wanted.size() < most / 2) CHECK(same_bits(quads, wanted));
  CHECK(log.messages().empty());
}

TEST_CASE("many blocks of trees and of cells are summed as on the CPU") {
  constexpr std::uint32_t kMany = glsl::kScanBlock * glsl::kSumThreads + 5000;
  const gl::HeadlessContext context;
  PlantStore store(plants());
  set_details(store, make_details(plants(), Law::ours));
  Forest forest = make_forest(kMany, 4);
  forest.runs = {{0, kMany}};
  Uploaded up = upload(forest);
  up.view.error_at_1m = 4.0 / 700;
  Extractor extractor(forest.sites, {.quads = 1U << 24, .lines = 1U << 22, .points = 1U << 24});
  extract(extractor, store, up.view);
  Selection expected;
  select(store.table, {forest.sites, forest.rows, forest.runs, up.view.error_at_1m}, expected);
  const auto totals = read<glsl::Totals>(extractor.totals, 1).front();
  CHECK(totals.cells > glsl::kScanBlock * glsl::kSumThreads);
  CHECK(totals.missing == glm::uvec4(0));
  REQUIRE(items_of(totals) == expected.items.size());
  CHECK(same_bits(read<Item>(extractor.items, expected.items.size()), expected.items));
  std::vector<glm::uvec2> wanted;
  for (std::uint32_t i = 0; i < expected.items.size(); ++i)
    for (std::uint32_t rank = 0; expected.items[i].kind <= glsl::kLeaves && rank < expected.items[i].count;
         rank += glsl::kQuadGroup)
      wanted.emplace_back(i, rank);
  CHECK(same_bits(read<glm::uvec2>(extractor.groups, totals.groups.x), wanted));
}

namespace {

/// A forest that wants more than these limits of every list, near and far.
constexpr ExtractLimits kSmall{.cells = 1500, .quads = 30'000, .lines = 3000, .points = 15'000};

std::array<std::size_t, 4> list_ends(const glsl::Capacity& room) {
  return {0, room.quad_groups, room.quad_groups + room.line_groups,
          std::size_t{room.quad_groups} + room.line_groups + room.point_groups};
}

}  // namespace

TEST_CASE("where lists lack room the error rises and nothing is missing and both processors agree") {
  const gl::HeadlessContext context;
  PlantStore store(plants());
  set_details(store, make_details(plants(), Law::ours));
  CostTable costs = make_costs(store.table);
  const Forest forest = make_forest(1500, 8);
  Uploaded up = upload(forest);
  const double asked = 0.3 / 700;
  TreesSeen seen{forest.sites, forest.rows, forest.runs, asked};
  const ExtractLimits plenty;
  for (int list = 0; list < 5; ++list) {
    ExtractLimits limits = list == 4 ? kSmall : plenty;
    if (list == 0) limits.cells = kSmall.cells;
    if (list == 1) limits.quads = kSmall.quads;
    if (list == 2) limits.lines = kSmall.lines;
    if (list == 3) limits.points = kSmall.points;
    Extractor extractor(forest.sites, limits);
    up.view.error_at_1m = asked;
    extract(extractor, store, up.view);
    glFinish();
    INFO("list " << list);
    CHECK(newest_shown(extractor).missing > 0);

    seen.error_at_1m = asked;
    seen.error_at_1m = up.view.error_at_1m = error_for(costs, store.table, seen, {.room = room_of(extractor.capacity)});
    CHECK(seen.error_at_1m > asked);
    extract(extractor, store, up.view);
    glFinish();
    const Shown shown = newest_shown(extractor);
    CHECK(shown.missing == 0);
    Selection expected;
    select(store.table, seen, expected);
    CHECK(same_bits(read<Item>(extractor.items, expected.items.size()), expected.items));
    CHECK(shown.leaves == count_shown(expected).leaves);
    CHECK(shown.leaves + shown.points > 0);
  }
}

TEST_CASE("without a budget lists end where their room does and hold what the others would") {
  const gl::HeadlessContext context;
  gl::ErrorLog log;
  PlantStore store(plants());
  set_details(store, make_details(plants(), Law::ours));
  const Forest forest = make_forest(1500, 8);
  Uploaded up = upload(forest);
  up.view.error_at_1m = 0.3 / 700;
  Extractor small(forest.sites, kSmall), large(forest.sites, {});
  extract(small, store, up.view);
  extract(large, store, up.view);
  const auto of_small = read<glsl::Totals>(small.totals, 1).front(),
             of_large = read<glsl::Totals>(large.totals, 1).front();
  REQUIRE(of_large.missing == glm::uvec4(0));
  REQUIRE(of_small.cells == kSmall.cells);
  CHECK(of_small.missing.x == of_large.cells - kSmall.cells);
  const std::uint32_t items = items_of(of_small);
  CHECK(same_bits(read<Item>(small.items, items), read<Item>(large.items, items)));
  const auto ends = list_ends(small.capacity), whole = list_ends(large.capacity);
  const auto groups = read<glm::uvec2>(small.groups, ends[3]), wanted = read<glm::uvec2>(large.groups, whole[3]);
  for (int list = 0; list < 3; ++list) {
    INFO("list " << list);
    const auto n = of_small.groups[list] - of_small.missing[list + 1];
    CHECK(n <= ends[static_cast<std::size_t>(list) + 1] - ends[static_cast<std::size_t>(list)]);
    CHECK(of_small.groups[list] <= of_large.groups[list]);  // fewer: of cells that are missing
    CHECK(std::equal(groups.begin() + static_cast<std::ptrdiff_t>(ends[static_cast<std::size_t>(list)]),
                     groups.begin() + static_cast<std::ptrdiff_t>(ends[static_cast<std::size_t>(list)] + n),
                     wanted.begin() + static_cast<std::ptrdiff_t>(whole[static_cast<std::size_t>(list)])));
  }
  CHECK(of_small.groups.x - of_small.missing.y == small.capacity.quad_groups);
  CHECK(log.messages().empty());
}

TEST_CASE("sums of groups end at the largest number instead of beginning again") {
  const gl::HeadlessContext context;
  PlantStore store(plants());
  set_details(store, make_details(plants(), Law::full));
  for (glm::uvec2& step : store.table.steps) step.x = 1U << 30;  // 16 trees of 2^28 groups: 2^32
  store.steps = gl::make_buffer(std::as_bytes(std::span(store.table.steps)));
  Forest forest = make_forest(16, 3);
  forest.runs = {{0, 16}};
  const Uploaded up = upload(forest);
  Extractor extractor(forest.sites, {.quads = 4000, .points = 64});
  extract(extractor, store, up.view);
  const auto totals = read<glsl::Totals>(extractor.totals, 1).front();
  CHECK(totals.groups.x == ~0U);
  CHECK(totals.missing.y > 1U << 31);
  for (const glm::uvec2& group : read<glm::uvec2>(extractor.groups, extractor.capacity.quad_groups))
    CHECK(group.x == 0);
}

TEST_CASE("node after node the lists hold what they do all at once") {
  const gl::HeadlessContext context;
  PlantStore store(plants());
  set_details(store, make_details(plants(), Law::ours));
  const Forest forest = make_forest(700, 5);
  const Uploaded up = upload(forest);
  Extractor at_once(forest.sites, {}), by_node(forest.sites, {});
  extract(at_once, store, up.view);
  extract_by_node(by_node, store, up.view, forest.runs);
  const auto of_all = read<glsl::Totals>(at_once.totals, 1).front(),
             of_nodes = read<glsl::Totals>(by_node.totals, 1).front();
  REQUIRE(items_of(of_nodes) == items_of(of_all));
  REQUIRE(of_nodes.groups == of_all.groups);
  CHECK(of_nodes.shown == of_all.shown);
  CHECK(same_bits(read<TreeRecord>(by_node.trees, up.view.trees), read<TreeRecord>(at_once.trees, up.view.trees)));
  const std::uint32_t items = items_of(of_all);
  CHECK(same_bits(read<Item>(by_node.items, items), read<Item>(at_once.items, items)));
  const auto& room = at_once.capacity;
  const auto ends = list_ends(room);
  auto groups = read<glm::uvec2>(by_node.groups, ends[3]), wanted = read<glm::uvec2>(at_once.groups, ends[3]);
  const auto before = [](const glm::uvec2& a, const glm::uvec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
  for (std::size_t list = 0; list < 3; ++list) {  // bark and leaves share one: node by node, or all bark first
    for (auto* all : {&groups, &wanted})
      std::sort(all->begin() + static_cast<std::ptrdiff_t>(ends[list]),
                all->begin() + static_cast<std::ptrdiff_t>(ends[list + 1]), before);
  }
  CHECK(same_bits(groups, wanted));
  const std::size_t words = static_cast<std::size_t>(command_places(room).points) / 4 + 4;
  CHECK(same_bits(read<GLuint>(by_node.commands, words), read<GLuint>(at_once.commands, words)));
}

}  // namespace manzana::foliage

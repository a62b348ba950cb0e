#include "foliage/gl/extract.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <stdexcept>

#include "gl/program.h"
#include "manzana_foliage_gl_shaders.h"

namespace manzana::foliage {
namespace {

using glsl::Capacity;
using glsl::Totals;
static_assert(sizeof(Totals) == 240 && offsetof(Totals, missing) == offsetof(Totals, shown) + sizeof(Totals::shown));

constexpr GLintptr kCommandBytes = 5 * sizeof(GLuint);

std::uint32_t ceil_div(std::uint32_t a, std::uint32_t b) { return (a + b - 1) / b; }

Capacity capacity_of(const ExtractLimits& limits) {
  return {.cells = std::min(limits.cells, kMostCells),
          .quad_groups = ceil_div(limits.quads, glsl::kQuadGroup),
          .line_groups = ceil_div(limits.lines, glsl::kLineGroup),
          .point_groups = ceil_div(limits.points, glsl::kPointGroup),
          .quad_draws = ceil_div(limits.quads, glsl::kQuadsOfDraw),
          .line_draws = ceil_div(limits.lines, glsl::kQuadsOfDraw),
          .spare0 = 0,
          .spare1 = 0};
}

/// `sums`: what foliage/shaders/sums.glsl adds.
gl::Program make_pass(std::string_view name, const gl::Pieces& sums, std::string_view main) {
  using namespace shaders;
  gl::Pieces pieces{version_glsl, select_layout_glsl, extract_glsl, buffers_glsl,
                    hash_glsl,    octahedral_glsl,    select_glsl};
  pieces.insert(pieces.end(), sums.begin(), sums.end());
  pieces.push_back(main);
  return gl::make_compute_program(name, pieces);
}

template <class T>
gl::Buffer make_room(std::size_t n) {
  return gl::make_buffer(n * sizeof(T));
}

void to(GLuint binding, const gl::Buffer& buffer) {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.name());
}

template <class Sum>
Extractor::Sums make_sums(std::size_t n) {
  return {make_room<Sum>(n), make_room<Sum>(n / glsl::kScanBlock + 1)};
}

void bind(const Extractor& e, const TreesInView& view) {
  to(kSitesBinding, e.sites);
  to(kTotalsBinding, e.totals);
  to(kTreesBinding, e.trees);
  to(kTreeOffsetsBinding, e.tree_sums.offsets);
  to(kTreeBlocksBinding, e.tree_sums.blocks);
  to(kItemsBinding, e.items);
  to(kItemCountsBinding, e.counts);
  to(kGroupsBinding, e.groups);
  to(kCommandsBinding, e.commands);
  glBindBufferRange(GL_SHADER_STORAGE_BUFFER, kSitesInViewBinding, view.buffer, view.offset,
                    static_cast<GLsizeiptr>(std::max(view.trees, 1U) * sizeof(GLuint)));
}

void bind(const Extractor::Sums& sums) {
  to(kOffsetsBinding, sums.offsets);
  to(kBlocksBinding, sums.blocks);
}

void finish_writes() { glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT); }

void dispatch(const gl::Program& program, std::uint32_t groups) {
  glUseProgram(program.name());
  glDispatchCompute(groups, 1, 1);
  finish_writes();
}

void dispatch_indirect(const gl::Program& program, GLintptr offset) {
  glUseProgram(program.name());
  glDispatchComputeIndirect(offset);
  finish_writes();
}

}  // namespace

Extractor::Extractor(std::span<const TreeSite> all, const ExtractLimits& limits)
    : most_trees(static_cast<std::uint32_t>(all.size())),
      capacity(capacity_of(limits)),
      sites(gl::make_buffer(std::as_bytes(all))),
      trees(make_room<TreeRecord>(all.size())),
      items(make_room<Item>(all.size() * glsl::kFixedItems + capacity.cells)),
      groups(make_room<glm::uvec2>(std::size_t{capacity.quad_groups} + capacity.line_groups + capacity.point_groups)),
      commands(gl::make_buffer(static_cast<std::size_t>(command_places(capacity).points + kCommandBytes))),
      totals(make_room<Totals>(1)),
      shown(std::make_unique<gl::Readback>(sizeof(Totals::shown) + sizeof(Totals::missing))),
      counts(make_room<glm::uvec4>(all.size())),
      tree_sums(make_sums<glm::uvec4>(all.size())),
      cell_sums(make_sums<GLuint>(capacity.cells)),
      place(make_pass("place", {}, shaders::place_comp)),
      scan_trees(make_pass("scan_trees", {"#define Sum uvec4\n", shaders::sums_glsl}, shaders::scan_trees_comp)),
      choose(make_pass("choose", {}, shaders::choose_comp)),
      scan_cells(make_pass("scan_cells", {"#define Sum uint\n", shaders::sums_glsl}, shaders::scan_cells_comp)),
      expand(make_pass("expand", {}, shaders::expand_comp)) {}

namespace {

void start(Extractor& e, const PlantStore& store, const TreesInView& view) {
  assert(view.trees <= e.most_trees);
  Totals totals{};
  totals.error2_at_1m = error2_at_1m(view.error_at_1m);
  totals.heed_neighbours = view.heed_neighbours ? 1 : 0;
  totals.all_trees = view.trees;
  totals.capacity = e.capacity;
  std::copy(view.sides.begin(), view.sides.end(), totals.view_sides);
  glNamedBufferSubData(e.totals.name(), 0, sizeof totals, &totals);
  bind(store);
  bind(e, view);
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, e.totals.name());
}

/// Trees in view [trees.first, trees.last): after those of earlier nodes.
void extract_node(Extractor& e, const Run& trees) {
  const std::array<GLuint, 2> node{trees.size(), trees.first};
  static_assert(offsetof(Totals, first_tree) == sizeof(GLuint));
  glNamedBufferSubData(e.totals.name(), offsetof(Totals, trees), sizeof node, node.data());
  bind(e.tree_sums);
  dispatch(e.place, ceil_div(trees.size(), 64));
  dispatch(e.scan_trees, ceil_div(trees.size(), glsl::kScanBlock));
  bind(e.cell_sums);
  dispatch_indirect(e.choose, offsetof(Totals, per_cell));
  dispatch_indirect(e.scan_cells, offsetof(Totals, per_block));
  dispatch_indirect(e.expand, offsetof(Totals, per_row));
}

void finish(Extractor& e) {
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  e.shown->copy(e.totals, offsetof(Totals, shown));
}

}  // namespace

void extract(Extractor& e, const PlantStore& store, const TreesInView& view) {
  start(e, store, view);
  if (view.trees > 0) extract_node(e, {0, view.trees});
  finish(e);
}

void extract_by_node(Extractor& e, const PlantStore& store, const TreesInView& view, std::span<const Run> nodes) {
  start(e, store, view);
  std::uint32_t first = 0;
  for (const Run& node : nodes) {
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    extract_node(e, {first, first + node.size()});
    first += node.size();
  }
  finish(e);
}

Shown newest_shown(Extractor& extractor) {
  std::array<glm::uvec4, 2> read{};
  if (const std::byte* bytes = extractor.shown->newest()) std::memcpy(read.data(), bytes, sizeof read);
  const auto& [shown, missing] = read;
  return {shown.x, shown.y, shown.z, shown.w, std::uint64_t{missing.x} + missing.y + missing.z + missing.w};
}

ListSizes room_of(const Capacity& capacity) {
  return {capacity.cells, capacity.quad_groups, capacity.line_groups, capacity.point_groups};
}

CommandPlaces command_places(const Capacity& capacity) {
  const GLintptr lines = kCommandBytes * capacity.quad_draws;
  return {.quads = 0, .lines = lines, .points = lines + kCommandBytes * capacity.line_draws};
}

}  // namespace manzana::foliage

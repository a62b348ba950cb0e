// Lists of one tree's leaves against the rule that says which are kept, leaf by leaf.
#include "foliage/gl/index_list.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "foliage/generate.h"
#include "foliage/import/species.h"
#include "foliage/lod_factor.h"
#include "foliage/prepare.h"
#include "gl/context.h"
#include "gl/error_log.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "tests/support/random.h"

namespace manzana::foliage {
namespace {

const std::vector<PreparedPlant>& plants() {
  static const std::vector<PreparedPlant> all = [] {
    std::vector<PreparedPlant> made;
    for (const char* name : {"shrub", "broadleaf"})  // the second does not begin at 0; cells of few leaves
      made.push_back(prepare(grow_plant(builtin_species(name), 7), {.quads_per_cell = 2, .visibility_side = 0}));
    return made;
  }();
  return all;
}

template <class T>
std::vector<T> read(const gl::Buffer& buffer, std::size_t n) {
  std::vector<T> values(n);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(buffer.name(), 0, static_cast<GLsizeiptr>(n * sizeof(T)), values.data());
  return values;
}

/// As the CPU chooses: of each cell the first kept().
std::vector<std::uint32_t> indices_of(const PlantTable& table, std::uint32_t plant, const std::vector<float>& lods) {
  std::vector<std::uint32_t> all;
  const PlantHead& head = table.plants[plant];
  for (std::uint32_t i = 0; i < head.cells; ++i) {
    const CellHead& cell = table.cells[head.first_cell + i];
    for (std::uint32_t rank = 0; rank < kept(cell.count, static_cast<double>(lods[i])); ++rank)
      for (const std::uint32_t corner : {0, 1, 2, 0, 2, 3})
        all.push_back(4 * (head.first_quad + cell.first + rank) + corner);
  }
  return all;
}

std::vector<float> lods_of(std::uint32_t cells, int how) {
  constexpr float kLess = 1 - 0x1p-24F;
  support::Random random(static_cast<std::uint64_t>(how));
  std::vector<float> lods(cells);
  for (float& lod : lods) {
    const auto f = static_cast<float>(random.within(0, 1));
    const std::array<float, 8> ways{0, 1, 0.33F, kLess, 0x1p-149F, f, std::round(f), f < 0.9F ? 0 : 1 + 0x1p-23F};
    lod = ways[static_cast<std::size_t>(how)];
  }
  return lods;
}

}  // namespace

TEST_CASE("an index list holds the leaves that the rule keeps and no others in order") {
  const gl::HeadlessContext context;
  gl::ErrorLog log;
  const PlantStore store(plants());
  for (std::uint32_t plant = 0; plant < plants().size(); ++plant) {
    IndexList list(store, plant);
    REQUIRE(list.cells > 256);  // more than a work group sums at once
    for (int how = 0; how < 8; ++how) {
      INFO("plant " << plant << " how " << how);
      const std::vector<float> lods = lods_of(list.cells, how);
      write_list(list, store, lods);
      const auto wanted = indices_of(store.table, plant, lods);
      const auto command = read<GLuint>(list.command, 5);
      CHECK(command == std::vector<GLuint>{static_cast<GLuint>(wanted.size()), 1, 0, 0, 0});
      CHECK(read<std::uint32_t>(list.indices, wanted.size()) == wanted);
    }
  }
  CHECK(log.messages().empty());
}

TEST_CASE("an index list keeps nothing where a level of detail is not a number") {
  const gl::HeadlessContext context;
  const PlantStore store(plants());
  IndexList list(store, 0);
  write_list(list, store, std::vector<float>(list.cells, std::numeric_limits<float>::quiet_NaN()));
  CHECK(read<GLuint>(list.command, 1).front() == 0);
}

TEST_CASE("one draw shows two triangles for each leaf of an index list") {
  const gl::HeadlessContext context;
  gl::ErrorLog log;
  const PlantStore store(plants());
  IndexList list(store, 1);
  write_list(list, store, lods_of(list.cells, 6));
  const gl::Target target = gl::make_target(4, 4, 1);
  gl::bind(target);
  const gl::Program program =
      gl::make_program("nowhere", {"#version 450 core\n", "void main() { gl_Position = vec4(2); }"},
                       {"#version 450 core\n", "void main() {}"});
  glUseProgram(program.name());
  glEnable(GL_RASTERIZER_DISCARD);
  GLuint query = 0, triangles = 0;
  glCreateQueries(GL_PRIMITIVES_GENERATED, 1, &query);
  glBeginQuery(GL_PRIMITIVES_GENERATED, query);
  draw_list(list);
  glEndQuery(GL_PRIMITIVES_GENERATED);
  glGetQueryObjectuiv(query, GL_QUERY_RESULT, &triangles);
  glDeleteQueries(1, &query);
  glDisable(GL_RASTERIZER_DISCARD);
  CHECK(triangles > 0);
  CHECK(3 * triangles == read<GLuint>(list.command, 1).front());
  CHECK(log.messages() == std::vector<std::string>{});
}

}  // namespace manzana::foliage

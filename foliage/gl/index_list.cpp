#include "foliage/gl/index_list.h"

#include <cassert>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/vertex_array.h"
#include "manzana_foliage_gl_shaders.h"

namespace manzana::foliage {
namespace {

constexpr std::size_t kIndicesOfQuad = 6;
constexpr GLintptr kDispatch = 8 * sizeof(GLuint);  // in IndexList::command, behind the draw's
constexpr std::size_t kCommandWords = 11;

gl::Program make_pass(std::string_view name, std::string_view main) {
  using namespace shaders;
  return gl::make_compute_program(name, {version_glsl, select_layout_glsl, index_list_glsl, main});
}

void use(const gl::Program& program, const IndexList& list) {
  glUseProgram(program.name());
  glUniform1ui(0, list.first_cell);
  glUniform1ui(1, list.cells);
  glUniform1ui(2, list.first_quad);
}

void bind(const IndexList& list, const PlantStore& store) {
  const auto to = [](GLuint binding, const gl::Buffer& buffer) {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.name());
  };
  to(kCellsBinding, store.cells);
  to(kDetailsBinding, list.lods);
  to(kOffsetsBinding, list.offsets);
  to(kCommandsBinding, list.command);
  to(kGroupsBinding, list.indices);
}

}  // namespace

IndexList::IndexList(const PlantStore& store, std::uint32_t plant)
    : first_cell(store.table.plants[plant].first_cell),
      cells(store.table.plants[plant].cells),
      first_quad(store.table.plants[plant].first_quad),
      lods(gl::make_buffer(cells * sizeof(float))),
      offsets(gl::make_buffer(cells * sizeof(GLuint))),
      command(gl::make_buffer(kCommandWords * sizeof(GLuint))),
      indices(gl::make_buffer(std::size_t{leaf_quads(store.table, store.table.plants[plant])} * kIndicesOfQuad *
                              sizeof(GLuint))),
      count(make_pass("index_count", shaders::index_count_comp)),
      write(make_pass("index_write", shaders::index_write_comp)),
      array(gl::make_vertex_array(indices)) {}

void write_list(IndexList& list, const PlantStore& store, std::span<const float> lods) {
  assert(lods.size() == list.cells);
  glNamedBufferSubData(list.lods.name(), 0, static_cast<GLsizeiptr>(lods.size_bytes()), lods.data());
  bind(list, store);
  use(list.count, list);
  glDispatchCompute(1, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
  use(list.write, list);
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, list.command.name());
  glDispatchComputeIndirect(kDispatch);
  glMemoryBarrier(GL_ELEMENT_ARRAY_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void draw_list(const IndexList& list) {
  glBindVertexArray(list.array.name());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, list.command.name());
  glDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr);
}

}  // namespace manzana::foliage

#pragma once
/// Vertex arrays that have no attributes: what is drawn is read from storage buffers.
///   VertexArray array = make_vertex_array(indices);
#include "gl/handle.h"

namespace manzana::gl {

inline VertexArray make_vertex_array() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  return VertexArray(name);
}

inline VertexArray make_vertex_array(const Buffer& indices) {
  VertexArray array = make_vertex_array();
  glVertexArrayElementBuffer(array.name(), indices.name());
  return array;
}

}  // namespace manzana::gl

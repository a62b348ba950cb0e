#pragma once
/// Lays a picture of ours over a host's, each pixel with its depth: so a host may have any format, any samples and any
/// depth, and what it drew before is hidden, or hides, as it should.
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "scenegraph/draw/renderer.h"

namespace manzana::draw {

struct Compositor {
  Compositor();
  gl::Program program;
  gl::VertexArray nothing;
};

/// Into the bound framebuffer. target's colour and depth resolved.
void draw_overlay(const Compositor& compositor, const gl::Target& target, const Overlay& how);

}  // namespace manzana::draw

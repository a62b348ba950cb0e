#include "tests/view/host.h"

#include <catch2/catch.hpp>
#include <thread>

#include "foliage/import/load_plant.h"
#include "gl/program.h"

namespace manzana {
namespace {

constexpr std::string_view kVertex = R"(#version 450
layout(location = 0) uniform float depth;
void main() {
  vec2 at = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(at, 2.0 * depth - 1.0, 1.0);
})";
constexpr std::string_view kFragment = R"(#version 450
layout(location = 1) uniform vec4 value;
layout(location = 0) out vec4 colour;
void main() { colour = value; })";

}  // namespace

HostWindow::HostWindow(int w, int h) : width(w), height(h) {
  GLuint buffers[2], framebuffer = 0, array = 0;
  glCreateRenderbuffers(2, buffers);
  colour_ = gl::Renderbuffer(buffers[0]);
  depth_ = gl::Renderbuffer(buffers[1]);
  glNamedRenderbufferStorage(buffers[0], GL_RGBA8, w, h);
  glNamedRenderbufferStorage(buffers[1], GL_DEPTH24_STENCIL8, w, h);
  glCreateFramebuffers(1, &framebuffer);
  framebuffer_ = gl::Framebuffer(framebuffer);
  glNamedFramebufferRenderbuffer(framebuffer, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers[0]);
  glNamedFramebufferRenderbuffer(framebuffer, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, buffers[1]);
  REQUIRE(glCheckNamedFramebufferStatus(framebuffer, GL_DRAW_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
  program_ = gl::make_program("host", {kVertex}, {kFragment});
  glCreateVertexArrays(1, &array);
  array_ = gl::VertexArray(array);
}

void HostWindow::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(0, 0, width, height);
}

void HostWindow::clear(float r, float g, float b, float a) const {
  bind();
  glDepthMask(GL_TRUE);
  glClearColor(r, g, b, a);
  glClearDepth(1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

void HostWindow::fill(const std::array<float, 4>& colour, float depth) const {
  bind();
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glUseProgram(program_.name());
  glUniform1f(0, depth);
  glUniform4fv(1, 1, colour.data());
  glBindVertexArray(array_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

std::vector<Rgba> HostWindow::pixels() const {
  std::vector<unsigned char> bytes(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  bind();
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
  std::vector<Rgba> out(bytes.size() / 4);
  for (std::size_t i = 0; i < bytes.size(); ++i) out[i / 4].c[i % 4] = bytes[i];
  return out;
}

float HostWindow::depth_at(int x, int y) const {
  float depth = 0;
  bind();
  glReadPixels(x, y, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
  return depth;
}

HostCamera looking(const Vec3d& eye, const Vec3d& at, int width, int height) {
  HostCamera camera;
  camera.projection =
      glm::perspective(glm::radians(60.0), static_cast<double>(width) / static_cast<double>(height), 0.5, 5000.0);
  camera.view = glm::lookAt(eye, at, Vec3d(0, 0, 1));
  camera.viewport = {0, 0, width, height};
  return camera;
}

HostCamera street_camera(int width, int height) { return looking({0, -300, 60}, {0, 0, 10}, width, height); }

std::shared_ptr<const Model> town() {
  static const std::shared_ptr<const Model> model =
      Model::load("builtin:town", {.cars = 100, .plant_cache = foliage::default_cache_folder()});
  return model;
}

void bring_all(View& view, const HostWindow& window, const HostCamera& camera) {
  const std::array<HostCamera, 1> cameras{camera};
  for (int frame = 0; frame < 100'000; ++frame) {
    const Update& now = view.update(cameras, 0);
    if (now.far_trees_left + now.pictures_left > 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    window.bind();
    view.render(0);
    if (view.complete()) return;
  }
  FAIL("something never came");
}

std::vector<Rgba> picture(View& view, const HostWindow& window, const HostCamera& camera) {
  bring_all(view, window, camera);
  window.clear(0, 0, 0, 0);
  view.render(0);
  return window.pixels();
}

double share_different(const std::vector<Rgba>& a, const std::vector<Rgba>& b, int tolerance) {
  REQUIRE(a.size() == b.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    int most = 0;
    for (std::size_t k = 0; k < 4; ++k) most = std::max(most, std::abs(a[i].c[k] - b[i].c[k]));
    different += most > tolerance ? 1 : 0;
  }
  return static_cast<double>(different) / static_cast<double>(a.size());
}

}  // namespace manzana

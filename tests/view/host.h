#pragma once
/// A host as programs with maps have them: a framebuffer of its own, 8 bits a channel, 24 bits of depth as OpenGL
/// starts with, and drawing of its own.
#include <array>
#include <glm/gtc/matrix_transform.hpp>

#include "gl/buffer.h"
#include "gl/context.h"
#include "gl/handle.h"
#include "manzana/view.h"

namespace manzana {

struct Rgba {
  std::array<int, 4> c{};
  bool operator==(const Rgba&) const = default;
};

class HostWindow {
 public:
  HostWindow(int width, int height);
  void bind() const;
  /// Clears, as a host does at the start of a frame.
  void clear(float r, float g, float b, float a) const;
  /// A rectangle over the whole picture, of one colour, at a depth of the host's, 0 to 1.
  void fill(const std::array<float, 4>& colour, float depth) const;
  std::vector<Rgba> pixels() const;  ///< rows from the bottom
  float depth_at(int x, int y) const;
  int width, height;

 private:
  gl::Renderbuffer colour_, depth_;
  gl::Framebuffer framebuffer_;
  gl::Program program_;
  gl::VertexArray array_;
};

/// From above a street of the built-in town.
HostCamera street_camera(int width, int height);
HostCamera looking(const Vec3d& eye, const Vec3d& at, int width, int height);

std::shared_ptr<const Model> town();

/// Updates and renders until all is made and uploaded, then a picture over a cleared window.
std::vector<Rgba> picture(View& view, const HostWindow& window, const HostCamera& camera);
void bring_all(View& view, const HostWindow& window, const HostCamera& camera);

double share_different(const std::vector<Rgba>& a, const std::vector<Rgba>& b, int tolerance);

}  // namespace manzana

#include "tests/draw/picture.h"

#include <cstdlib>

namespace manzana::draw {

std::array<int, 3> Picture::at(int x, int y) const {
  const std::size_t i =
      3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  return {rgb.at(i), rgb.at(i + 1), rgb.at(i + 2)};
}

Picture take_picture(Renderer& renderer, Size size, const Scene& scene, const VisibleSets& sets,
                     const culling::View& view, const DrawOptions& options) {
  renderer.resize(size);
  renderer.draw(scene, sets, view, options);
  return {size.width, size.height, renderer.read_pixels()};
}

Vec2d project(const culling::View& view, Size size, const Vec3d& point) {
  const Vec3d d = point - view.eye;
  const double depth = glm::dot(d, view.forward);
  const double x = (glm::dot(d, view.right) / depth - view.tan_left) / (view.tan_right - view.tan_left);
  const double y = (view.tan_top - glm::dot(d, view.up) / depth) / (view.tan_top - view.tan_bottom);
  return {x * size.width, y * size.height};
}

int different_pixels(const Picture& a, const Picture& b, int tolerance) {
  int different = 0;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
    int most = 0;
    for (std::size_t c = i; c < i + 3; ++c) most = std::max(most, std::abs(int{a.rgb[c]} - int{b.rgb.at(c)}));
    different += most > tolerance ? 1 : 0;
  }
  return different;
}

bool reddish(const std::array<int, 3>& c) { return c[0] > 2 * c[1] && c[0] > 2 * c[2]; }
bool greenish(const std::array<int, 3>& c) { return c[1] > c[0] + 10 && c[1] > c[2] + 10; }
bool bluish(const std::array<int, 3>& c) { return c[2] > c[0] + 10; }

}  // namespace manzana::draw

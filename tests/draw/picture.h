#pragma once
/// A rendered picture, and the exact place in it of a point, by double arithmetic that shares nothing with the
/// renderer.
#include <array>
#include <vector>

#include "culling/frustum.h"
#include "scenegraph/draw/renderer.h"

namespace manzana::draw {

struct Picture {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;  ///< rows from the top
  std::array<int, 3> at(int x, int y) const;
};

Picture take_picture(Renderer& renderer, Size size, const Scene& scene, const VisibleSets& sets,
                     const culling::View& view, const DrawOptions& options = {});

/// Pixels from the left and from the top; the middle of the first pixel is (0.5, 0.5).
Vec2d project(const culling::View& view, Size size, const Vec3d& point);

/// Pixels with a channel that differs by more than `tolerance`.
int different_pixels(const Picture& a, const Picture& b, int tolerance);

bool reddish(const std::array<int, 3>& c);
bool greenish(const std::array<int, 3>& c);
bool bluish(const std::array<int, 3>& c);

}  // namespace manzana::draw

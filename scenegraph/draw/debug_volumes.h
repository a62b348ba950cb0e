#pragma once
/// The tree's volumes as lines: what a frozen frustum sees, looked at from elsewhere. Of the lanes that are not
/// outside: where a lane is a node, a box and, if its sphere tells more, that one's three circles, coloured by depth;
/// where it is a block, a box, coloured by whether it is inside; and the frozen pyramid. Only for looking: allocates.
#include <vector>

#include "culling/bqr_tree.h"
#include "culling/frustum.h"
#include "gl/buffer.h"
#include "gl/program.h"

namespace manzana::draw {

struct LineVertex {
  Vec3 position;  ///< relative to the eye
  Vec3 colour;    ///< as it is shown, linear
};

/// Pairs of vertices, a line each.
std::vector<LineVertex> volume_lines(const culling::BqrTree& tree, const culling::View& frozen, const Vec3d& eye);

struct DebugVolumes {
  DebugVolumes();
  gl::VertexArray array;
  gl::Program program;
};
void draw_lines(const DebugVolumes& volumes, const std::vector<LineVertex>& lines);

}  // namespace manzana::draw

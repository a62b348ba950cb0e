#include "scenegraph/draw/debug_volumes.h"

#include <array>
#include <cmath>
#include <numbers>

#include "culling/overlap.h"
#include "gl/vertex_array.h"
#include "manzana_draw_shaders.h"

namespace manzana::draw {
namespace {

using Lines = std::vector<LineVertex>;
constexpr Vec3 kInside{0.1F, 0.9F, 0.2F}, kCrossing{1.0F, 0.6F, 0.05F}, kPyramid{1.0F, 1.0F, 0.1F};
constexpr double kPyramidLength = 400;  // metres

void add_line(Lines& lines, const Vec3d& a, const Vec3d& b, const Vec3& colour) {
  lines.push_back({Vec3(a), colour});
  lines.push_back({Vec3(b), colour});
}

Vec3 depth_colour(std::uint32_t depth) {
  constexpr std::array kColours{Vec3(0.9F, 0.1F, 0.1F), Vec3(0.9F, 0.4F, 0.8F), Vec3(0.5F, 0.3F, 1.0F),
                                Vec3(0.2F, 0.5F, 1.0F), Vec3(0.1F, 0.8F, 0.9F), Vec3(0.6F, 0.9F, 0.3F)};
  return kColours[depth % kColours.size()];
}

void add_circles(Lines& lines, const Vec3d& center, double radius, const Vec3& colour) {
  constexpr int kSides = 48;
  const auto point = [&](int axis, int i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    Vec3d p = center;
    p[(axis + 1) % 3] += radius * std::cos(angle);
    p[(axis + 2) % 3] += radius * std::sin(angle);
    return p;
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < kSides; ++i) add_line(lines, point(axis, i), point(axis, i + 1), colour);
  }
}

void add_box(Lines& lines, const Vec3d& low, const Vec3d& high, const Vec3& colour) {
  const auto corner = [&](unsigned i) {
    return Vec3d((i & 1U) != 0 ? high.x : low.x, (i & 2U) != 0 ? high.y : low.y, (i & 4U) != 0 ? high.z : low.z);
  };
  for (unsigned i = 0; i < 8; ++i) {
    for (const unsigned axis : {1U, 2U, 4U}) {
      if ((i & axis) == 0) add_line(lines, corner(i), corner(i | axis), colour);
    }
  }
}

void add_pyramid(Lines& lines, const culling::View& view, const Vec3d& eye) {
  const double length = std::isfinite(view.far_m) ? view.far_m : kPyramidLength;
  const Vec3d apex = view.eye - eye;
  std::array<Vec3d, 4> base;
  for (std::size_t i = 0; i < 4; ++i) {
    const double x = i == 0 || i == 3 ? view.tan_left : view.tan_right, y = i < 2 ? view.tan_bottom : view.tan_top;
    base[i] = apex + (view.forward + view.right * x + view.up * y) * length;
  }
  for (std::size_t i = 0; i < 4; ++i) {
    add_line(lines, apex, base[i], kPyramid);
    add_line(lines, base[i], base[(i + 1) % 4], kPyramid);
  }
}

/// What a query would come to from this node on. `origin`: the tree's, relative to the eye.
void add_lanes(Lines& lines, const culling::BqrTree& tree, std::uint32_t at, const culling::Frustum& frustum,
               const Vec3d& origin) {
  using culling::Overlap;
  const culling::BqrNode& node = tree.nodes[at];
  for (std::uint32_t i = 0; i < culling::kLanes; ++i) {
    if ((node.lanes >> i & 1) == 0) continue;
    const culling::SphereD ball = lane_sphere(node, i);
    const culling::BoxD box = lane_box(node, i);
    const Overlap where = overlap(frustum, narrow(ball, Vec3d(0)), narrow(box, Vec3d(0)));
    if (where == Overlap::outside) continue;
    if ((node.blocks >> i & 1) != 0) {
      add_box(lines, origin + box.min, origin + box.max, where == Overlap::inside ? kInside : kCrossing);
      continue;
    }
    if ((node.balls >> i & 1) != 0) add_circles(lines, origin + ball.center, ball.radius, depth_colour(node.depth));
    add_box(lines, origin + box.min, origin + box.max, depth_colour(node.depth));
    add_lanes(lines, tree, node.child[i], frustum, origin);
  }
}

}  // namespace

std::vector<LineVertex> volume_lines(const culling::BqrTree& tree, const culling::View& frozen, const Vec3d& eye) {
  const culling::Frustum frustum = culling::narrow(culling::make_frustum(frozen), tree.origin);
  Lines lines;
  if (!tree.nodes.empty()) add_lanes(lines, tree, tree.root, frustum, tree.origin - eye);
  add_pyramid(lines, frozen, eye);
  return lines;
}

DebugVolumes::DebugVolumes()
    : program(gl::make_program(
          "line", {shaders::version_glsl, shaders::frame_layout_glsl, shaders::frame_glsl, shaders::line_vert},
          {shaders::version_glsl, shaders::line_frag})) {
  array = gl::make_vertex_array();
  const GLuint name = array.name();
  for (GLuint attribute = 0; attribute < 2; ++attribute) {
    glEnableVertexArrayAttrib(name, attribute);
    glVertexArrayAttribBinding(name, attribute, 0);
    glVertexArrayAttribFormat(name, attribute, 3, GL_FLOAT, GL_FALSE, attribute * static_cast<GLuint>(sizeof(Vec3)));
  }
}

void draw_lines(const DebugVolumes& volumes, const std::vector<LineVertex>& lines) {
  const gl::Buffer buffer = gl::make_buffer(std::as_bytes(std::span(lines)));
  glUseProgram(volumes.program.name());
  glVertexArrayVertexBuffer(volumes.array.name(), 0, buffer.name(), 0, sizeof(LineVertex));
  glBindVertexArray(volumes.array.name());
  glDrawArrays(GL_LINES, 0, static_cast<GLsizei>(lines.size()));
}

}  // namespace manzana::draw

#include "foliage/import/gltf_triangles.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "foliage/import/gltf_accessor.h"
#include "foliage/import/gltf_materials.h"

namespace manzana::foliage {
namespace {

using Mat4d = glm::dmat4;

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error(what); }

bool finite(const Vec3d& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool finite(const Mat4d& m) {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      if (!std::isfinite(m[c][r])) return false;
  return true;
}

/// Unit quaternion x, y, z, w as a rotation.
Mat4d rotation(const std::vector<double>& q, const std::string& where) {
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(length > 1e-12) || !std::isfinite(length)) fail(where + ": its rotation is no quaternion");
  const double x = q[0] / length, y = q[1] / length, z = q[2] / length, w = q[3] / length;
  Mat4d m(1);
  m[0] = {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0};
  m[1] = {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0};
  m[2] = {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0};
  return m;
}

Mat4d from_parts(const tinygltf::Node& node, const std::string& where) {
  const auto sized = [&](const std::vector<double>& v, std::size_t n) {
    if (!v.empty() && v.size() != n) fail(where + ": a transform has not " + std::to_string(n) + " numbers");
    return !v.empty();
  };
  Mat4d m(1);
  if (sized(node.rotation, 4)) m = rotation(node.rotation, where);
  if (sized(node.scale, 3))
    for (int c = 0; c < 3; ++c) m[c] *= node.scale[static_cast<std::size_t>(c)];
  if (sized(node.translation, 3)) m[3] = {node.translation[0], node.translation[1], node.translation[2], 1};
  return m;
}

Mat4d local_transform(const tinygltf::Node& node, const std::string& where) {
  if (node.matrix.empty()) return from_parts(node, where);
  if (node.matrix.size() != 16) fail(where + ": its matrix has not 16 numbers");
  Mat4d m;
  for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
  return m;
}

/// Volume spanned by the axes over the product of their lengths is 0, or an axis is.
bool singular(const Mat4d& m) {
  const double a = glm::length(Vec3d(m[0])), b = glm::length(Vec3d(m[1])), c = glm::length(Vec3d(m[2]));
  if (!(a > 0 && b > 0 && c > 0)) return true;
  return !(std::abs(glm::dot(Vec3d(m[0]) / a, glm::cross(Vec3d(m[1]) / b, Vec3d(m[2]) / c))) > 1e-9);
}

struct Placed {
  int node;
  Mat4d transform;
  int parent = -1;  ///< among those that are found
  Mat4d placement{1};
};

/// Nodes, and where they are. No recursion: files nest as deep as they like.
class Walk {
 public:
  explicit Walk(const tinygltf::Model& model) : model_(model), seen_(model.nodes.size(), false) {}

  std::vector<Placed> run() {
    // y up to z up: (x, y, z) -> (x, -z, y)
    Mat4d up(0);
    up[0][0] = 1, up[1][2] = 1, up[2][1] = -1, up[3][3] = 1;
    for (const int root : roots()) todo_.push_back({root, up, -1, {}});
    while (!todo_.empty()) {
      const Placed parent = todo_.back();
      todo_.pop_back();
      visit(parent);
    }
    return std::move(out_);
  }

 private:
  std::vector<int> roots() const {
    if (!model_.scenes.empty()) {
      const auto scene = static_cast<std::size_t>(std::max(model_.defaultScene, 0));
      if (scene >= model_.scenes.size()) fail("there is no scene " + std::to_string(scene));
      return model_.scenes[scene].nodes;
    }
    std::vector<bool> child(model_.nodes.size(), false);
    for (const tinygltf::Node& node : model_.nodes)
      for (const int c : node.children)
        if (c >= 0 && static_cast<std::size_t>(c) < child.size()) child[static_cast<std::size_t>(c)] = true;
    std::vector<int> out;
    for (std::size_t i = 0; i < child.size(); ++i)
      if (!child[i]) out.push_back(static_cast<int>(i));
    return out;
  }

  void visit(const Placed& parent) {
    const std::string where = "node " + std::to_string(parent.node);
    if (parent.node < 0 || static_cast<std::size_t>(parent.node) >= seen_.size()) fail(where + " does not exist");
    const auto index = static_cast<std::size_t>(parent.node);
    if (seen_[index]) fail(where + " is in a cycle, or has two parents");
    seen_[index] = true;
    const tinygltf::Node& node = model_.nodes[index];
    const Mat4d placement = local_transform(node, where), transform = parent.transform * placement;
    if (!finite(transform)) fail(where + ": its transform is not finite");
    if (singular(transform)) {
      mark_below(node);
      return;
    }
    const int self = static_cast<int>(out_.size());
    out_.push_back({parent.node, transform, parent.parent, placement});
    for (const int child : node.children) todo_.push_back({child, transform, self, {}});
  }

  /// Of a node that is scaled to nothing the children are not drawn either; a cycle among them is harmless.
  void mark_below(const tinygltf::Node& node) {
    std::vector<int> below = node.children;
    while (!below.empty()) {
      const int child = below.back();
      below.pop_back();
      if (child < 0 || static_cast<std::size_t>(child) >= seen_.size() || seen_[static_cast<std::size_t>(child)])
        continue;
      seen_[static_cast<std::size_t>(child)] = true;
      const auto& children = model_.nodes[static_cast<std::size_t>(child)].children;
      below.insert(below.end(), children.begin(), children.end());
    }
  }

  const tinygltf::Model& model_;
  std::vector<bool> seen_;
  std::vector<Placed> todo_, out_;
};

int attribute(const tinygltf::Primitive& primitive, const char* name) {
  const auto found = primitive.attributes.find(name);
  return found == primitive.attributes.end() ? -1 : found->second;
}

/// Strips and fans as separate triangles. [glTF 2.0, section 3.7.2.1]
std::vector<std::uint32_t> as_triangles(const std::vector<std::uint32_t>& in, int mode) {
  if (mode == TINYGLTF_MODE_TRIANGLES) return {in.begin(), in.begin() + static_cast<std::ptrdiff_t>(in.size() / 3 * 3)};
  std::vector<std::uint32_t> out;
  for (std::size_t i = 0; i + 2 < in.size(); ++i) {
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
      out.insert(out.end(), {in[i + 1], in[i + 2], in[0]});
    else
      out.insert(out.end(), {in[i], in[i + 1 + i % 2], in[i + 2 - i % 2]});
  }
  return out;
}

std::vector<std::uint32_t> triangle_indices(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                            std::size_t vertices, const std::string& where) {
  std::vector<std::uint32_t> indices;
  if (primitive.indices >= 0) {
    indices = read_indices(model, primitive.indices);
  } else {
    for (std::uint32_t i = 0; i < vertices; ++i) indices.push_back(i);
  }
  for (const std::uint32_t i : indices)
    if (i >= vertices) fail(where + ": index " + std::to_string(i) + " of " + std::to_string(vertices) + " vertices");
  return as_triangles(indices, primitive.mode);
}

class PartReader {
 public:
  PartReader(const tinygltf::Model& model, const Placed& placed, const std::string& where)
      : model_(model), placed_(placed), where_(where) {}

  SourcePart read(const tinygltf::Primitive& primitive) const {
    SourcePart part;
    part.material = primitive.material;
    if (part.material >= 0 && static_cast<std::size_t>(part.material) >= model_.materials.size())
      fail(where_ + ": there is no material " + std::to_string(part.material));
    part.material = std::max(part.material, -1);
    part.positions = positions(attribute(primitive, "POSITION"));
    part.indices = triangle_indices(model_, primitive, part.positions.size(), where_);
    // A mirror turns the triangles round.
    if (glm::determinant(glm::dmat3(placed_.transform)) < 0)
      for (std::size_t t = 0; t + 2 < part.indices.size(); t += 3) std::swap(part.indices[t + 1], part.indices[t + 2]);
    part.normals = normals(attribute(primitive, "NORMAL"), part);
    part.uvs = uvs(attribute(primitive, "TEXCOORD_0"), part.positions.size());
    part.branch_ids = branch_ids(attribute(primitive, "_BRANCHID"), part.positions.size());
    return part;
  }

 private:
  std::vector<Vec3d> positions(int accessor) const {
    if (accessor < 0) fail(where_ + ": a primitive has no POSITION");
    const std::vector<double> values = read_values(model_, accessor, 3);
    std::vector<Vec3d> out;
    out.reserve(values.size() / 3);
    for (std::size_t i = 0; i + 2 < values.size(); i += 3) {
      out.emplace_back(placed_.transform * glm::dvec4(values[i], values[i + 1], values[i + 2], 1));
      if (!finite(out.back())) fail(where_ + ": position " + std::to_string(i / 3) + " is not finite");
    }
    return out;
  }

  std::vector<Vec3> normals(int accessor, const SourcePart& part) const {
    if (accessor < 0) return computed_normals(part);
    const std::vector<double> values = read_values(model_, accessor, 3);
    if (values.size() != 3 * part.positions.size()) fail(where_ + ": NORMAL and POSITION differ in count");
    const glm::dmat3 turn = glm::transpose(glm::inverse(glm::dmat3(placed_.transform)));
    std::vector<Vec3> out;
    out.reserve(part.positions.size());
    for (std::size_t i = 0; i + 2 < values.size(); i += 3) {
      const Vec3d n = turn * Vec3d(values[i], values[i + 1], values[i + 2]);
      const double length = glm::length(n);
      out.push_back(length > 0 && std::isfinite(length) ? Vec3(n / length) : Vec3(0, 0, 1));
    }
    return out;
  }

  std::vector<Vec2> uvs(int accessor, std::size_t count) const {
    std::vector<Vec2> out(count, Vec2(0));
    if (accessor < 0) return out;
    const std::vector<double> values = read_values(model_, accessor, 2);
    if (values.size() != 2 * count) fail(where_ + ": TEXCOORD_0 and POSITION differ in count");
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!(std::abs(values[i]) < 1e6)) fail(where_ + ": a texture coordinate is not finite, or over a million");
      out[i / 2][static_cast<int>(i % 2)] = static_cast<float>(values[i]);
    }
    return out;
  }

  std::vector<std::int32_t> branch_ids(int accessor, std::size_t count) const {
    if (accessor < 0) return {};
    const std::vector<double> values = read_values(model_, accessor, 1);
    if (values.size() != count) fail(where_ + ": _BRANCHID and POSITION differ in count");
    std::vector<std::int32_t> out;
    for (const double v : values) {
      if (!(v >= 0 && v < 1 << 24)) fail(where_ + ": a _BRANCHID is not within 0 .. 16777215");
      out.push_back(static_cast<std::int32_t>(std::lround(v)));
    }
    return out;
  }

  const tinygltf::Model& model_;
  const Placed& placed_;
  std::string where_;
};

bool has_triangles(const tinygltf::Primitive& primitive) {
  return primitive.mode == TINYGLTF_MODE_TRIANGLES || primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
         primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

/// Of all parts so far.
struct Sizes {
  std::size_t vertices = 0, indices = 0;
};

std::vector<SourcePart> parts_of(const tinygltf::Model& model, int index, const Placed& placed, Sizes& sizes) {
  const std::string where = "mesh " + std::to_string(index);
  if (index < 0 || static_cast<std::size_t>(index) >= model.meshes.size()) fail("there is no " + where);
  const tinygltf::Mesh& mesh = model.meshes[static_cast<std::size_t>(index)];
  const PartReader reader(model, placed, where);
  std::vector<SourcePart> parts;
  for (const tinygltf::Primitive& primitive : mesh.primitives) {
    if (!has_triangles(primitive)) continue;
    SourcePart part = reader.read(primitive);
    sizes.vertices += part.positions.size();
    sizes.indices += part.indices.size();
    if (sizes.vertices > kMaxSourceVertices || sizes.indices > kMaxSourceIndices)
      fail("more triangles than a model may have");
    part.name = mesh.name;
    for (const tinygltf::Value* extras : {&primitive.extras, &mesh.extras})
      if (!part.told) part.told = told_by_extras(*extras);
    if (!part.indices.empty()) parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace

std::vector<SourcePart> gltf_triangles(const tinygltf::Model& model) {
  std::vector<SourcePart> parts;
  Sizes sizes;
  for (const Placed& placed : Walk(model).run()) {
    const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(placed.node)];
    if (node.mesh < 0) continue;
    for (SourcePart& part : parts_of(model, node.mesh, placed, sizes)) {
      if (part.name.empty()) part.name = node.name;
      if (!part.told) part.told = told_by_extras(node.extras);
      parts.push_back(std::move(part));
    }
  }
  if (parts.empty()) fail("no triangles in its scene");
  return parts;
}

std::vector<GltfNode> gltf_nodes(const tinygltf::Model& model) {
  std::vector<GltfNode> nodes;
  for (const Placed& placed : Walk(model).run()) {
    const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(placed.node)];
    nodes.push_back({placed.parent, node.name, placed.placement, node.mesh});
  }
  return nodes;
}

std::vector<SourcePart> gltf_mesh(const tinygltf::Model& model, int mesh) {
  Sizes sizes;
  return parts_of(model, mesh, {-1, Mat4d(1), -1, Mat4d(1)}, sizes);
}

}  // namespace manzana::foliage

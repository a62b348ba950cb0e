#include "foliage/plant.h"

#include <cmath>
#include <stdexcept>

namespace manzana::foliage {
namespace {

constexpr float kFarthest = 1e6F;  // metres; squares of lengths stay far from a float's end

[[noreturn]] void fail(const std::string& what) { throw std::invalid_argument("plant: " + what); }

[[noreturn]] void fail(const char* kind, std::size_t row, const char* what) {
  fail(std::string(kind) + " " + std::to_string(row) + " " + what);
}

bool sane(float v) { return std::abs(v) <= kFarthest; }  // false for NaN
bool sane(const Vec3& v) { return sane(v.x) && sane(v.y) && sane(v.z); }

void check(const MeshPart& part, const char* vertex, const char* triangle) {
  if (part.indices.size() % 3 != 0) fail(std::string(triangle) + "s have indices that are no multiple of three");
  for (std::size_t i = 0; i < part.indices.size(); ++i)
    if (part.indices[i] >= part.vertices.size()) fail(triangle, i / 3, "has a vertex that does not exist");
  for (std::size_t i = 0; i < part.vertices.size(); ++i) {
    const MeshVertex& v = part.vertices[i];
    if (!sane(v.position) || !sane(v.normal) || !sane(v.uv.x) || !sane(v.uv.y) || !sane(v.shade))
      fail(vertex, i, "is not finite or out of range");
  }
}

/// Runs in order that leave nothing out.
class Cover {
 public:
  Cover(const char* kind, std::size_t end) : kind_(kind), end_(end) {}

  void add(std::size_t row, const Run& run) {
    if (run.last < run.first || run.first != next_) fail(kind_, row, "does not begin where the one before ends");
    if (run.last > end_) fail(kind_, row, "has triangles that do not exist");
    next_ = run.last;
  }

  void finish() const {
    if (next_ != end_) fail("triangle " + std::to_string(next_) + " belongs to no " + kind_);
  }

 private:
  const char* kind_;
  std::size_t end_, next_ = 0;
};

void check_branch(const Plant& plant, std::size_t row, std::size_t& line_end) {
  const Branch& branch = plant.branches[row];
  if (branch.parent < -1 || branch.parent >= static_cast<std::int64_t>(row))
    fail("branch", row, "has a parent that is not before it");
  const Run& line = branch.line;
  if (line.last < line.first || line.size() == 1 || line.last > plant.centre_lines.size())
    fail("branch", row, "has a centre line that is no line");
  if (line.size() == 0) return;
  if (line.first < line_end) fail("branch", row, "shares its centre line with one before");
  line_end = line.last;
}

void check_image(const Image& image, const char* name) {
  const auto side = static_cast<std::size_t>(image.size);
  if (image.size < 0 || (side & (side - 1)) != 0 || image.rgba.size() != 4 * side * side)
    fail(std::string(name) + " image is no square of a power of two");
}

}  // namespace

void check(const Plant& plant) {
  check(plant.mesh.bark, "bark vertex", "bark triangle");
  check(plant.mesh.leaves, "leaf vertex", "leaf triangle");
  check_image(plant.leaf_image, "the leaf");
  check_image(plant.bark_image, "the bark");
  for (std::size_t i = 0; i < plant.centre_lines.size(); ++i) {
    const CentrePoint& point = plant.centre_lines[i];
    if (!sane(point.position) || !sane(point.radius) || point.radius < 0)
      fail("centre point", i, "is not finite or out of range");
  }
  Cover bark("branch", plant.mesh.bark.triangles()), leaves("terminal", plant.mesh.leaves.triangles());
  std::size_t line_end = 0;
  for (std::size_t i = 0; i < plant.branches.size(); ++i) {
    check_branch(plant, i, line_end);
    bark.add(i, plant.branches[i].triangles);
  }
  for (std::size_t i = 0; i < plant.terminals.size(); ++i) {
    const Terminal& terminal = plant.terminals[i];
    if (terminal.branch < -1 || terminal.branch >= static_cast<std::int64_t>(plant.branches.size()))
      fail("terminal", i, "is on a branch that does not exist");
    if (terminal.triangles.size() == 0) fail("terminal", i, "has no triangle");
    leaves.add(i, terminal.triangles);
  }
  bark.finish();
  leaves.finish();
}

}  // namespace manzana::foliage

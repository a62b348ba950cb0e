#include "foliage/branch_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "foliage/farthest_pair.h"

namespace manzana::foliage {
namespace {

constexpr float kTolerance = 0.5F;  // of the radius: a branch becomes a line when that is a pixel or less
constexpr std::uint32_t kLongest = 64;

/// Distance to the piece from a to b, plus the difference to its radius there.
float deviation(const CentrePoint& p, const CentrePoint& a, const CentrePoint& b) {
  const Vec3 along = b.position - a.position;
  const float length2 = glm::dot(along, along);
  const float t = length2 > 0 ? std::clamp(glm::dot(p.position - a.position, along) / length2, 0.0F, 1.0F) : 0;
  return glm::length(p.position - (a.position + t * along)) + std::abs(p.radius - glm::mix(a.radius, b.radius, t));
}

bool keeps_within(std::span<const CentrePoint> line, std::uint32_t first, std::uint32_t last, float tolerance) {
  for (std::uint32_t i = first + 1; i < last; ++i)
    if (!(deviation(line[i], line[first], line[last]) <= tolerance)) return false;
  return true;
}

/// Of a ribbon that always turns its full width to the eye; pi / 4 is the mean of |sin|.
double ribbon_area(std::span<const CentrePoint> line) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    sum += static_cast<double>(line[i].radius + line[i + 1].radius) *
           static_cast<double>(glm::length(line[i + 1].position - line[i].position));
  return std::numbers::pi / 4 * sum;
}

std::vector<CentrePoint> few_points(std::span<const CentrePoint> line, float widest) {
  std::vector<CentrePoint> few;
  for (const std::uint32_t i : fewest_points(line, kTolerance * widest)) few.push_back(line[i]);
  return few;
}

/// A branch's corners, three for each triangle.
class Corners {
 public:
  Corners(const Plant& plant, const Branch& branch)
      : bark_(plant.mesh.bark), first_(3 * std::size_t{branch.triangles.first}), size_(3 * branch.triangles.size()) {}

  std::uint32_t size() const { return size_; }
  const MeshVertex& operator[](std::size_t i) const { return bark_.vertices[bark_.indices[first_ + i]]; }

 private:
  const MeshPart& bark_;
  std::size_t first_;
  std::uint32_t size_;
};

double surface(const Corners& corners) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const Vec3d a(corners[i].position), b(corners[i + 1].position), c(corners[i + 2].position);
    sum += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return sum;
}

float mean_shade(const Corners& corners) {
  if (corners.size() == 0) return 1;
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) sum += static_cast<double>(corners[i].shade);
  return static_cast<float>(sum / corners.size());
}

/// Between the farthest two corners; as thick as the corners lie far from it.
std::vector<CentrePoint> straight_line(const Corners& corners) {
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < corners.size(); ++i) places.push_back(corners[i].position);
  const auto ends = farthest_pair(places);
  if (!ends) return {};
  const CentrePoint a{places[ends->a], 0}, b{places[ends->b], 0};
  float radius = 0;
  for (const Vec3& place : places) radius = std::max(radius, deviation({place, 0}, a, b));
  return {{a.position, radius}, {b.position, radius}};
}

float widest_radius(std::span<const CentrePoint> line) {
  float radius = 0;
  for (const CentrePoint& point : line) radius = std::max(radius, point.radius);
  return radius;
}

void scale_radii(std::vector<CentrePoint>& line, double wanted) {
  const double has = ribbon_area(line);
  if (!(has > 0)) return;
  for (CentrePoint& point : line) point.radius *= static_cast<float>(wanted / has);
}

}  // namespace

std::vector<std::uint32_t> fewest_points(std::span<const CentrePoint> line, float tolerance) {
  const auto size = static_cast<std::uint32_t>(line.size());
  std::vector<std::uint32_t> pieces(size, 0),
      before(size, 0);  // at least so many up to a point, and where the last began
  for (std::uint32_t i = 1; i < size; ++i) {
    pieces[i] = std::numeric_limits<std::uint32_t>::max();
    for (std::uint32_t j = i > kLongest ? i - kLongest : 0; j < i; ++j)
      if (pieces[j] + 1 < pieces[i] && keeps_within(line, j, i, tolerance)) pieces[i] = pieces[j] + 1, before[i] = j;
  }
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = size - 1; i > 0; i = before[i]) kept.push_back(i);
  kept.push_back(0);
  std::reverse(kept.begin(), kept.end());
  return kept;
}

BranchShape branch_shape(const Plant& plant, const Branch& branch) {
  BranchShape shape;
  const Corners corners(plant, branch);
  const auto centre = std::span(plant.centre_lines).subspan(branch.line.first, branch.line.size());
  shape.line = centre.empty() ? straight_line(corners) : few_points(centre, widest_radius(centre));
  const float radius = std::max(widest_radius(centre), widest_radius(shape.line));
  // A tube of few sides hides less than its circle; more than that it cannot hide, whatever its surface.
  const double round_area = ribbon_area(centre.empty() ? std::span<const CentrePoint>(shape.line) : centre);
  const double triangle_area = surface(corners) / 4;
  const double area = triangle_area > 0 ? std::min(triangle_area, round_area) : round_area;
  scale_radii(shape.line, area);
  shape.width_m = 2 * std::max(radius, widest_radius(shape.line));
  shape.area_m2 = static_cast<float>(area);
  shape.visibility = mean_shade(corners);
  for (std::size_t i = 0; i + 1 < shape.line.size(); ++i)
    shape.length_m += glm::length(shape.line[i + 1].position - shape.line[i].position);
  return shape;
}

}  // namespace manzana::foliage

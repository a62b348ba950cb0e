#include "foliage/branch_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "foliage/leaf_points.h"
#include "foliage/texel_mean.h"

namespace manzana::foliage {
namespace {

double area_of(const LineSegment& line) {
  return static_cast<double>((line.radius_a + line.radius_b) * glm::distance(line.a, line.b));
}

/// Linear, mean over the whole picture.
Vec3 bark_colour(const PreparedPlant& plant) {
  const TexelMeans means(plant.bark_image);
  const Vec2d o(0, 0), x(1, 0), y(0, 1), xy(1, 1);
  return 0.5 * (means.over({o, x, xy}).colour + means.over({o, xy, y}).colour);
}

/// Where so much of a tapered ribbon's area lies before it, 0 to 1.
float place_on(const LineSegment& line, float share) {
  const float a = line.radius_a, b = line.radius_b, wider = b * b - a * a;
  const float root = std::sqrt(a * a + share * wider);
  return a + root > 0 ? share * (a + b) / (a + root) : share;
}

CloudPoint point_on(const LineSegment& line, float share, const Vec3& colour) {
  CloudPoint point;
  point.position = glm::mix(line.a, line.b, place_on(line, share));
  point.normal = line.b - line.a;
  point.shade = line.shade;
  point.colour = colour;
  point.level = std::min(line.level, 3U);
  return point;
}

}  // namespace

std::vector<LeafPoint> branch_points(const PreparedPlant& plant, std::uint32_t count) {
  double all = 0;
  for (const LineSegment& line : plant.lines) all += line.branch != kOfLeaf ? area_of(line) : 0;
  if (!(all > 0)) return {};
  const Vec3 bark = bark_colour(plant);
  const double step = all / count;
  PointCloud cloud;
  double before = 0, next = 0.5 * step;
  for (const LineSegment& line : plant.lines) {
    const double area = line.branch != kOfLeaf ? area_of(line) : 0;
    for (; next < before + area && cloud.size() < count; next += step) {
      cloud.push_back(point_on(line, static_cast<float>((next - before) / area), bark));
      cloud.back().area = static_cast<float>(std::numbers::pi / 4 * step);
    }
    before += area;
  }
  std::vector<Vec3> positions;
  for (const CloudPoint& point : cloud) positions.push_back(point.position);
  std::vector<LeafPoint> points;
  for (const std::uint32_t row : progressive_order(positions)) points.push_back(packed(cloud[row]));
  return points;
}

}  // namespace manzana::foliage

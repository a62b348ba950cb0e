#include "foliage/line_levels.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace manzana::foliage {
namespace {

constexpr int kFinest = -6, kCoarsest = 3;  // powers of two times the widest branch
constexpr float kPlace = 0.25F;             // of the error

struct Extent {
  double area = 0, length = 0;
};

/// Of the pieces between the points at these places.
Extent extent_of(std::span<const CentrePoint> line, std::span<const std::uint32_t> places) {
  Extent extent;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const CentrePoint &a = line[places[i]], &b = line[places[i + 1]];
    const auto length = static_cast<double>(glm::distance(a.position, b.position));
    extent.area += static_cast<double>(a.radius + b.radius) * length;
    extent.length += length;
  }
  return extent;
}

Extent extent_of(std::span<const CentrePoint> line) {
  std::vector<std::uint32_t> all(line.size());
  std::iota(all.begin(), all.end(), 0U);
  return extent_of(line, all);
}

class Level {
 public:
  Level(float error_m, PreparedPlant& ready) : error_m_(error_m), ready_(ready) {}

  /// Of branches as thin as this one a share is left.
  void add(const BranchShape& shape, std::uint32_t branch, std::uint32_t level) {
    ready_.line_firsts.push_back(size());
    const Extent all = extent_of(shape.line);
    if (!(all.area > 0)) return;
    const double share = std::min(1.0, all.area / all.length / static_cast<double>(kThinLine * error_m_));
    area_ += all.area;
    const double before = std::floor(sum_);
    if (std::floor(sum_ += share) == before) return;
    const std::vector<std::uint32_t> kept = fewest_points(shape.line, kPlace * error_m_);
    const double left = extent_of(shape.line, kept).area;
    const auto wider = static_cast<float>(left > 0 ? all.area / (share * left) : 1);
    shown_ += all.area / share;
    for (std::size_t i = 0; i + 1 < kept.size(); ++i) {
      const CentrePoint &a = shape.line[kept[i]], &b = shape.line[kept[i + 1]];
      ready_.coarse_lines.push_back(
          {a.position, a.radius * wider, b.position, b.radius * wider, shape.visibility, level, branch});
    }
  }

  /// Those that are left hide what all did.
  void finish(std::uint32_t first) {
    const auto wider = static_cast<float>(shown_ > 0 ? area_ / shown_ : 1);
    for (LineSegment& line : std::span(ready_.coarse_lines).subspan(first))
      line.radius_a *= wider, line.radius_b *= wider;
    ready_.line_firsts.insert(ready_.line_firsts.end(), 2, size());  // no leaves' yet
  }

  std::uint32_t size() const { return static_cast<std::uint32_t>(ready_.coarse_lines.size()); }

 private:
  float error_m_;
  PreparedPlant& ready_;
  double sum_ = 0.5, area_ = 0, shown_ = 0;
};

}  // namespace

std::vector<float> line_level_errors(float widest_m) {
  std::vector<float> errors;
  for (int power = kFinest; power <= kCoarsest; ++power) errors.push_back(std::ldexp(widest_m, power));
  return errors;
}

void add_line_levels(const Plant& plant, std::span<const BranchShape> shapes, std::span<const std::uint32_t> order,
                     PreparedPlant& ready) {
  float widest = 0;
  for (const BranchShape& shape : shapes) widest = std::max(widest, shape.width_m);
  if (!(widest > 0)) return;
  for (const float error_m : line_level_errors(widest)) {
    Level level(error_m, ready);
    const std::uint32_t first = level.size();
    for (const std::uint32_t row : order) level.add(shapes[row], row, plant.branches[row].level);
    level.finish(first);
    ready.line_levels.push_back({{first, level.size()}, error_m});
  }
}

}  // namespace manzana::foliage

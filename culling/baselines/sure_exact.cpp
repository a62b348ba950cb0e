#include "culling/baselines/sure_exact.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace manzana::culling {
namespace {

/// Coordinates relative to the eye, direction, product and two sums each round once, the ends of the interval once: 6
/// units at most. 16, so that a point that is inside with this margin is inside in long double along every axis.
constexpr double kUnits = 16 * 0x1p-53;
constexpr std::size_t kFaces = 5;  // near with far, four sides
constexpr std::size_t kWord = 64;

}  // namespace

SureExact::SureExact(const View& view) : exact_(make_exact(view)), eye_(view.eye) {
  const auto size_of = [](double end) { return std::isfinite(end) ? std::abs(end) : 0; };
  for (const ExactView::Axis& axis : exact_.axes) {
    const Vec3d direction(axis.direction);
    const auto low = static_cast<double>(axis.low), high = static_cast<double>(axis.high);
    axes_.push_back({direction, glm::abs(direction), low, high, kUnits * (size_of(low) + size_of(high))});
  }
}

/// Comparisons with NaN are false: doubt.
SureExact::Verdict SureExact::along(const Axis& axis, const Vec3d& low, const Vec3d& high) {
  const Vec3d a = axis.direction * low, b = axis.direction * high;
  const Vec3d least = glm::min(a, b), most = glm::max(a, b);
  const double from = least.x + least.y + least.z, to = most.x + most.y + most.z;
  const double margin = kUnits * glm::dot(axis.size, glm::max(glm::abs(low), glm::abs(high))) + axis.margin;
  if (to < axis.low - margin || from > axis.high + margin) return Verdict::apart;
  return to > axis.low + margin && from < axis.high - margin ? Verdict::meets : Verdict::doubt;
}

/// The point, and all within the margin of it, is in what the camera sees.
bool SureExact::holds(const Vec3d& point) const {
  return std::all_of(axes_.begin(), axes_.begin() + kFaces,
                     [&](const Axis& axis) { return along(axis, point, point) == Verdict::meets; });
}

SureExact::Verdict SureExact::verdict(const BoxD& box) const {
  const Vec3d low = box.min - eye_, high = box.max - eye_;
  if (holds((low + high) / 2.0)) return Verdict::meets;
  Verdict all = Verdict::meets;
  for (const Axis& axis : axes_) {
    const Verdict one = along(axis, low, high);
    if (one == Verdict::apart) return one;
    if (one == Verdict::doubt) all = one;
  }
  return all;
}

bool SureExact::overlaps(const BoxD& box) const {
  if (box.empty()) return false;
  const Verdict sure = verdict(box);
  return sure == Verdict::doubt ? exactly_overlaps(exact_, box) : sure == Verdict::meets;
}

std::vector<std::uint64_t> SureExact::visible(std::span<const BoxD> boxes) const {
  std::vector<std::uint64_t> bits((boxes.size() + kWord - 1) / kWord);
  tbb::parallel_for(std::size_t{0}, bits.size(), [&](std::size_t word) {
    for (std::size_t i = word * kWord; i < std::min(boxes.size(), (word + 1) * kWord); ++i)
      if (overlaps(boxes[i])) bits[word] |= std::uint64_t{1} << i % kWord;
  });
  return bits;
}

}  // namespace manzana::culling

#include "culling/baselines/naive.h"

#include <array>

namespace manzana::baselines {
namespace {

using culling::BoxD;
using culling::ClipDepth;
using culling::View;

template <class Real>
using Vec = glm::vec<3, Real>;

/// Half-spaces dot(normal, p) + offset >= 0 for p = position in L - origin; normals of any length.
template <class Real>
struct Planes {
  std::array<glm::vec<4, Real>, 6> all;
  Vec3d origin{0, 0, 0};
};

/// Of a matrix as the textbook has them: far is the row of w less the row of z.
template <class Real>
Planes<Real> planes_of(const glm::mat<4, 4, Real>& m, const Vec3d& origin) {
  const auto rows = glm::transpose(m);
  return {{rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1], rows[3] + rows[2],
           rows[3] - rows[2]},
          origin};
}

HostMatrices host(const View& view) { return host_matrices(view, ClipDepth::minus_one_to_one); }

Planes<float> float_world(const View& view) {
  const HostMatrices m = host(view);
  return planes_of(Mat4(m.projection) * Mat4(m.view), Vec3d(0));
}

Planes<float> double_planes_in_float(const View& view) {
  const HostMatrices m = host(view);
  const auto exact = planes_of(m.projection * m.view, Vec3d(0));
  Planes<float> planes;
  for (std::size_t k = 0; k < 6; ++k) planes.all[k] = Vec4(exact.all[k] / glm::length(Vec3d(exact.all[k])));
  return planes;
}

Planes<float> float_at_eye(const View& view) {
  const HostMatrices m = host(view);
  return planes_of(Mat4(m.projection) * Mat4(Mat3(m.view)), view.eye);
}

Planes<float> parameters_in_float(const View& view) {
  const culling::FrustumD exact = make_frustum(view);
  Planes<float> planes{{}, view.eye};
  for (std::size_t k = 0; k < static_cast<std::size_t>(exact.count); ++k)
    planes.all[k] = Vec4(Vec4d(exact.planes[k].normal, exact.planes[k].offset));
  return planes;
}

Planes<double> double_world(const View& view) {
  const HostMatrices m = host(view);
  return planes_of(m.projection * m.view, Vec3d(0));
}

template <class Real>
bool outside(const Planes<Real>& planes, const BoxD& box) {
  const Vec<Real> low(box.min - planes.origin), high(box.max - planes.origin);
  for (const auto& plane : planes.all) {
    const Vec<Real> normal(plane);
    const Vec<Real> p = glm::mix(low, high, glm::greaterThanEqual(normal, Vec<Real>(0)));
    if (glm::dot(normal, p) + plane.w < 0) return true;
  }
  return false;
}

template <auto PlanesOf>
std::vector<bool> kept(const View& view, std::span<const BoxD> boxes) {
  const auto planes = PlanesOf(view);
  std::vector<bool> all;
  all.reserve(boxes.size());
  for (const BoxD& box : boxes) all.push_back(!outside(planes, box));
  return all;
}

template <auto PlanesOf>
double far_distance(const View& view) {
  const auto planes = PlanesOf(view);
  const Vec4d plane(planes.all[culling::kFar]);
  const double length = glm::length(Vec3d(plane));
  return length > 0 ? (glm::dot(Vec3d(plane), view.eye - planes.origin) + plane.w) / length
                    : std::numeric_limits<double>::quiet_NaN();
}

template <auto PlanesOf>
constexpr NaiveWay way(std::string_view slug, std::string_view what, std::string_view precision) {
  return {slug, what, precision, kept<PlanesOf>, far_distance<PlanesOf>};
}

constexpr std::array kWays{
    way<float_world>("float-world", "planes from the rows of projection times view, boxes in the world", "float"),
    way<double_planes_in_float>("cast-world", "the same planes made in double, then cast", "double, then float"),
    way<float_at_eye>("float-eye", "planes from the rows of projection times rotation, boxes relative to the eye",
                      "float"),
    way<parameters_in_float>("float-eye-exact", "planes from the camera's parameters, boxes relative to the eye",
                             "float"),
    way<double_world>("double-world", "planes from the rows of projection times view, boxes in the world", "double"),
};

}  // namespace

std::span<const NaiveWay> naive_ways() { return kWays; }

}  // namespace manzana::baselines

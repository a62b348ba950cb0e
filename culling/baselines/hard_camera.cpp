#include <array>
#include <sstream>

#include "culling/baselines/hard_cases.h"
#include "culling/baselines/host_matrices.h"

namespace manzana::baselines {
namespace {

using culling::ClipDepth;
using culling::View;

constexpr std::array kClipDepths{ClipDepth::minus_one_to_one, ClipDepth::zero_to_one, ClipDepth::reversed};

template <class T, std::size_t N>
const T& any_of(const std::array<T, N>& all, Random& random) {
  return all[random.below(N)];
}

std::string words(const Place& place, const View& view, std::string_view sort) {
  std::ostringstream out;
  out << sort << ", " << place.name << ", n " << view.near_m << ", f " << view.far_m << ", tangents " << view.tan_left
      << ' ' << view.tan_right << ' ' << view.tan_bottom << ' ' << view.tan_top;
  return out.str();
}

HardCamera of_matrices(const HostMatrices& host, std::string what) {
  return {make_frustum(host.projection, host.view, host.depth).frustum,
          make_exact(host.projection, host.view, host.depth), std::move(what)};
}

HardCamera perspective(Random& random, const Place& place) {
  const View view = hard_view(random, place);
  HostMatrices host = host_matrices(view, any_of(kClipDepths, random));
  host.projection *= random.chance(0.7) ? 1 : random.scale(1e-23, 1e20);
  return of_matrices(host, words(place, view, "matrices"));
}

/// Depths near enough to each other that float still knows where the far plane is, roughly.
HardCamera through_float(Random& random, const Place& place) {
  View view = hard_view(random, place);
  view.near_m = 1;
  view.far_m = 5000;
  HostMatrices host = host_matrices(view, any_of(kClipDepths, random));
  host.projection = Mat4d(Mat4(host.projection));
  return of_matrices(host, words(place, view, "float matrices"));
}

HardCamera orthographic(Random& random, const Place& place) {
  View view = hard_view(random, place);
  const double size = random.scale(1e-2, 1e6);
  view.tan_right = random.in(-0.5, 2);
  view.tan_left = -1;
  view.tan_top = 1;
  view.tan_bottom = -1;
  view.near_m = random.in(-size, size);
  view.far_m = view.near_m + random.scale(1, 1e6);
  return of_matrices(orthographic_matrices(view, size / 2, any_of(kClipDepths, random)),
                     words(place, view, "orthographic matrices"));
}

}  // namespace

/// Half of them are what people use.
View hard_view(Random& random, const Place& place) {
  const double fov = random.chance(0.5) ? 60 : any_of(kFieldsDeg, random);
  const double aspect = random.chance(0.5) ? 16.0 / 9 : random.scale(1e-3, 1e3);
  const Depths& depths = any_of(kDepths, random);
  const Vec3d eye = place.at + random.direction() * random.unit();
  View view = culling::look(eye, random.direction(), random.direction(), glm::radians(fov), aspect, depths.near_m,
                            depths.far_m);
  if (random.chance(0.2)) view.tan_left = random.in(-0.5, 0.9) * view.tan_right;
  if (random.chance(0.2)) view.tan_bottom = random.in(-0.5, 0.9) * view.tan_top;
  if (random.chance(0.2)) view.right = -view.right;
  return view;
}

HardCamera hard_camera(Random& random, const Place& place) {
  const double sort = random.unit();
  if (sort < 0.3) return perspective(random, place);
  if (sort < 0.4) return through_float(random, place);
  if (sort < 0.5) return orthographic(random, place);
  const View view = hard_view(random, place);
  return {make_frustum(view), make_exact(view), words(place, view, "view")};
}

}  // namespace manzana::baselines

#pragma once
/// Cameras and objects at which culling goes wrong, drawn at random: for the proof that nothing is lost, and for the
/// tables of what the naive ways lose.
///   Random random(seed);
///   HardCamera camera = hard_camera(random, kPlaces[3]);
///   HardCity hard = hard_city(camera.truth, random, {.objects = 2000});
///   ... exactly_overlaps(camera.truth, hard.city.boxes[i]) ...
#include <string>

#include "culling/baselines/city.h"
#include "culling/baselines/exact.h"
#include "culling/baselines/places.h"
#include "culling/baselines/random.h"

namespace manzana::baselines {

struct HardCamera {
  culling::FrustumD frustum;  ///< by the product, from a View or from a host's matrices
  culling::ExactView truth;   ///< of the same View or matrices
  std::string what;           ///< for messages
};

/// A perspective of any sort.
culling::View hard_view(Random& random, const Place& place);

/// Of any sort, the eye within a metre of the place: a View or a host's matrices, perspective or orthographic, finite
/// or not, narrow to wide, off the axis, mirrored, of any scale, through float.
HardCamera hard_camera(Random& random, const Place& place);

/// A city round one camera, from metres to a thousand kilometres wide. A tangent object has its deepest point 1e-9 to
/// 1e-1 m inside the camera's body, or outside for one in five, at a face, an edge or a corner of either; the others
/// lie anywhere, from a point to the size of the city, in one city of five to 1e7 m. Blocks have one object or a mixed
/// bag; some are balls that touch, with a point in them where they are deepest, so that their spheres are put to the
/// proof.
struct HardCity {
  City city;
  std::vector<bool> tangent;  ///< a flag an object
};
struct HardCityOptions {
  std::uint32_t objects = 2000;
  double tangent_share = 0.1;
};
HardCity hard_city(const culling::ExactView& truth, Random& random, const HardCityOptions& options);

}  // namespace manzana::baselines

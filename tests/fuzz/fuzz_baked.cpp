// Baked cities: any bytes, with checksums that fit, are refused or can be used: seen, hidden behind their own walls,
// worn, said something of, and merged, which may refuse what is nowhere.
#include <cstdint>

#include "scenegraph/horizon.h"
#include "scenegraph/import/baked_city.h"
#include "scenegraph/import/loose_city.h"
#include "scenegraph/import/picture_square.h"
#include "tests/import/baked/resummed.h"

namespace {

using namespace manzana;

void see(const Scene& scene) {
  VisibleSets sets(scene);
  const Vec3d eye(0, -50, 20);
  find_visible(scene, culling::look(eye, {0, 1, -0.3}, {0, 0, 1}, 1, 1), Structure::bqr, sets);
  Horizon horizon(scene);
  horizon.hide(scene, {eye, sets.frustum.planes[culling::kNear]}, sets);
  find_cars(scene, 1234567, sets);
  horizon.hide_cars(sets);
}

void read_all(const Scene& scene) {
  for (std::uint32_t row = 0; row < scene.buildings.table.size(); ++row) upright_walls(scene, row);
  for (const EncodedPicture& picture : scene.pictures.encoded) picture_square(picture, 8);
}

void merge_with_itself(const Imported& city) {
  try {
    LooseCity twice = loosened(city, city.scene.frame);
    join(twice, loosened(city, city.scene.frame));
    assemble(std::move(twice));
  } catch (const std::invalid_argument&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string bytes(reinterpret_cast<const char*>(data), size);
  baked::resum(bytes);
  try {
    const Imported city = read_baked_bytes(std::as_bytes(std::span(bytes.data(), bytes.size())), "fuzz");
    see(city.scene);
    read_all(city.scene);
    merge_with_itself(city);
  } catch (const std::runtime_error&) {
  }
  return 0;
}

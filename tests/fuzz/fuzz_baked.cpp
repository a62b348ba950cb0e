// Baked cities: any bytes, with checksums that fit, are refused or can be used.
#include <cstdint>

#include "scenegraph/import/baked_city.h"
#include "scenegraph/visible.h"
#include "tests/import/baked/resummed.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace manzana;
  std::string bytes(reinterpret_cast<const char*>(data), size);
  baked::resum(bytes);
  try {
    const Imported city = read_baked_bytes(std::as_bytes(std::span(bytes.data(), bytes.size())), "fuzz");
    VisibleSets sets(city.scene);
    find_visible(city.scene, culling::look({0, -50, 20}, {0, 1, -0.3}, {0, 0, 1}, 1, 1), Structure::bqr, sets);
    find_cars(city.scene, 1234567, sets);
  } catch (const std::runtime_error&) {
  }
  return 0;
}

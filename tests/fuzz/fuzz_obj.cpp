// examine_obj on any bytes: a plant that check() passes, or std::runtime_error.
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "foliage/import/obj_plant.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace manzana::foliage;
  try {
    check(examine_obj(std::span(data, size), "fuzz").plant);
  } catch (const std::runtime_error&) {
    return 0;
  }
  return 0;
}

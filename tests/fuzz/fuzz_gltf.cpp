// import_plant on any bytes: a plant or std::runtime_error.  manzana-fuzz-gltf CORPUS -max_len=65536
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "foliage/import/gltf_plant.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    manzana::foliage::import_plant(std::span(data, size), "fuzz");
  } catch (const std::runtime_error&) {
    return 0;
  }
  return 0;
}

// read_plant on any bytes: a plant that check() passes and prepare() takes, or std::runtime_error.  manzana-fuzz-gltf
// CORPUS -max_len=65536
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "foliage/import/gltf_plant.h"
#include "foliage/prepare.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace manzana::foliage;
  try {
    check(prepare(read_plant(std::span(data, size), "fuzz"), {.visibility_side = 0}));
  } catch (const std::runtime_error&) {
    return 0;
  }
  return 0;
}

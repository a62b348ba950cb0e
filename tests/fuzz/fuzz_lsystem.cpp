// parse_lsystems and grow_plant on any bytes: plants that check() passes, or std::runtime_error.
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "foliage/import/turtle.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace manzana::foliage;
  try {
    for (const LSystem& system : parse_lsystems({reinterpret_cast<const char*>(data), size})) check(grow_plant(system));
  } catch (const std::runtime_error&) {
    return 0;
  }
  return 0;
}

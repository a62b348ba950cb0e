// parse_species() and grow_plant() on any bytes: a plant that check() passes, or it is refused.
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "foliage/import/species.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace manzana::foliage;
  try {
    check(grow_plant(parse_species({reinterpret_cast<const char*>(data), size}), 1));
  } catch (const std::runtime_error&) {
  } catch (const std::invalid_argument&) {  // by grow_plant
  }
  return 0;
}

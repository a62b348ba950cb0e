// parse_species() and grow() on any bytes: a skeleton within its cap, or they are refused. The plant's pictures, whose
// cost no species changes, are left out.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>

#include "foliage/import/species.h"
#include "foliage/stems.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace manzana::foliage;
  try {
    const Skeleton skeleton = grow(parse_species({reinterpret_cast<const char*>(data), size}), 1);
    for (const Stem& stem : skeleton.stems)
      if (stem.points.size() < 2) std::abort();
  } catch (const std::runtime_error&) {
  } catch (const std::invalid_argument&) {  // by grow()
  }
  return 0;
}

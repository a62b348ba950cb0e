// read_ecosystem() on any bytes, and each plant of it: as many as there may be, all somewhere; or std::runtime_error.
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "foliage/import/ecosystem.h"
#include "tests/fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace manzana::foliage;
  static const InputFile file;
  constexpr std::uint64_t kEnough = 100'000;  // plants of one input; more would be slow and tell nothing
  try {
    const Ecosystem ecosystem = read_ecosystem(file.with({data, size}, "ecosystem.json"));
    std::uint64_t plants = 0;
    each_plant(
        ecosystem, [&](std::uint32_t, const Placement&) { return plants < kEnough; },
        [&](std::uint32_t plant, const Placement& at) {
          const auto sum = at.position.x + at.position.y + at.position.z + at.turn + at.scale;
          if (plant >= ecosystem.plants.size() || !std::isfinite(sum)) std::abort();
          ++plants;
        });
    if (plants > kMaxPlaced) std::abort();
  } catch (const std::runtime_error&) {
  }
  return 0;
}

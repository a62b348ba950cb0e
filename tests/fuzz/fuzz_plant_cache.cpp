// decoded() on any bytes, and on any lists behind a header that is right: a plant, or std::runtime_error.
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "foliage/import/plant_cache.h"

namespace {

void try_to_decode(std::span<const unsigned char> bytes) {
  try {
    manzana::foliage::decoded(bytes);
  } catch (const std::runtime_error&) {
    return;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try_to_decode({data, size});
  const std::string whole = manzana::foliage::with_header({reinterpret_cast<const char*>(data), size});
  try_to_decode({reinterpret_cast<const unsigned char*>(whole.data()), whole.size()});
  return 0;
}

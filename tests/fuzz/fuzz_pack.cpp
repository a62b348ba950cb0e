// decoded_pack() on any lists behind a header that is right: a pack whose mosaics can be chosen from anywhere, or
// std::runtime_error.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>

#include "foliage/import/ldm_cache.h"
#include "foliage/ldm_select.h"

namespace {

using namespace manzana;
using namespace manzana::foliage;

void choose_all_round(const LdmPack& pack) {
  const LdmTable table = make_ldm_table({&pack, 1});
  TreeSite site{};
  site.radius = site.height = 1;
  site.turn = {1, 0};
  const Run run{0, 1};
  LdmSelection chosen;
  for (const float away : {0.5F, 3.0F, 20.0F, 5000.0F})
    for (const Vec3& towards : {Vec3(1, 0, 0), Vec3(-0.6F, 0, 0.8F), Vec3(0, 0.6F, -0.8F), Vec3(0, 0, 1)}) {
      const std::array<Vec4, 3> rows{Vec4(1, 0, 0, away * towards.x), Vec4(0, 1, 0, away * towards.y),
                                     Vec4(0, 0, 1, away * towards.z)};
      choose_ldm(table, {{&site, 1}, rows, {&run, 1}, 500}, true, chosen);
      for (const LdmItem& item : chosen.items)
        if (item.last > pack.mosaics.size()) std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string whole = with_header(kPackKind, {reinterpret_cast<const char*>(data), size});
  try {
    choose_all_round(decoded_pack({reinterpret_cast<const unsigned char*>(whole.data()), whole.size()}));
  } catch (const std::runtime_error&) {
  }
  return 0;
}

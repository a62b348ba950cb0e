#include "foliage/ldm_pack.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "foliage/ldm_views.h"

namespace manzana::foliage {
namespace {

[[noreturn]] void fail(const std::string& what) { throw std::invalid_argument("pack: " + what); }

[[noreturn]] void fail(const char* list, std::size_t row, const char* what) {
  fail(std::string(list) + " " + std::to_string(row) + " " + what);
}

bool sane(const Vec3& v) { return std::abs(v.x) <= 1e6F && std::abs(v.y) <= 1e6F && std::abs(v.z) <= 1e6F; }

void check_block(const LdmPack& pack, std::size_t row) {
  const LdmBlock& b = pack.blocks[row];
  if (b.shrink > kLdmShrinks || b.pixel == 0 || (b.column + 1) * kLdmBlock * b.pixel > kLdmPixels ||
      (b.row + 1) * kLdmBlock * b.pixel > kLdmPixels)
    fail("block", row, "is out of range");
  const int side = kLdmBlock >> b.shrink;
  if (b.page >= pack.pages() || b.x + side > kLdmPage || b.y + side > kLdmPage || b.x % side != 0 || b.y % side != 0)
    fail("block", row, "leaves its page");
}

void check_mosaic(const LdmPack& pack, std::size_t row) {
  const LdmMosaic& m = pack.mosaics[row];
  if (m.block >= pack.blocks.size()) fail("mosaic", row, "has no block");
  if (m.left >= m.right || m.low >= m.high || m.right > kLdmBlock || m.high > kLdmBlock)
    fail("mosaic", row, "leaves its block");
}

void check_side(const LdmPack& pack, std::size_t row) {
  const LdmSide& side = pack.sides[row];
  if (!sane(side.towards) || !sane(side.right) || !sane(side.up)) fail("side", row, "is not finite");
  for (const Run& run : side.mosaics)
    if (run.last < run.first || run.last > pack.mosaics.size()) fail("side", row, "has a run that leaves its list");
}

}  // namespace

void check(const LdmPack& pack) {
  const LdmOptions& o = pack.options;
  if (!sane(pack.centre) || !(pack.radius > 0 && pack.radius <= 1e6F)) fail("its ball is not finite");
  if (!(pack.height_m >= 0 && pack.height_m <= 1e6F)) fail("its height is not finite");
  if (o.layers < 1 || o.sides > LdmSides::octahedral || !(o.focal_px > 0 && o.focal_px < 1e6) ||
      !(o.nearest_radii > 1 && o.nearest_radii < 1e6) || o.nearest < 0 || o.nearest >= level_count(o))
    fail("its options are out of range");
  for (const float grown : pack.grown)
    if (!(std::abs(grown) <= 1)) fail("its mosaics grow out of range");
  if (pack.sides.size() != ldm_directions(o.sides).size()) fail("it has not as many sides as its kind");
  if (pack.colour.size() != pack.surface.size() || pack.colour.size() % (4 * ldm_texels_to(1 + kLdmShrinks)) != 0)
    fail("its pages are not whole");
  for (std::size_t i = 0; i < pack.blocks.size(); ++i) check_block(pack, i);
  for (std::size_t i = 0; i < pack.mosaics.size(); ++i) check_mosaic(pack, i);
  for (std::size_t i = 0; i < pack.sides.size(); ++i) check_side(pack, i);
}

}  // namespace manzana::foliage

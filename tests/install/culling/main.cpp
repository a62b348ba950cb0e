// Ten boxes in two blocks; those before the camera are found.
#include <cstdio>
#include <vector>

#include "culling/bqr_tree.h"
#include "culling/cull.h"
#include "culling/frustum.h"

int main() {
  using namespace manzana;
  using namespace manzana::culling;
  std::vector<BlockVolume> blocks;
  std::vector<BoxD> boxes;
  std::vector<std::uint32_t> first{0};
  for (const double y : {100.0, -100.0}) {
    BoxD all;
    for (int i = 0; i < 5; ++i) {
      const Vec3d low(20.0 * i, y, 0);
      boxes.push_back({low, low + Vec3d(5, 5, 10)});
      all = merge(all, boxes.back());
    }
    blocks.push_back({Vec2d((all.min + all.max) / 2.0), all, enclosing_sphere(all)});
    first.push_back(static_cast<std::uint32_t>(boxes.size()));
  }
  const BqrTree tree = build_bqr_tree(blocks, {first, boxes});
  Answer answer(tree);
  cull(tree, make_planes(tree, make_frustum(look({40, 0, 5}, {0, 1, 0}, {0, 0, 1}, 1.2, 1.5))), answer);
  std::printf("%llu of %u\n", static_cast<unsigned long long>(count(ordered(answer))), tree.objects());
}

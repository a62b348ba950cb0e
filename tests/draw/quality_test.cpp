#include <catch2/catch.hpp>

#include "scenegraph/draw/renderer.h"

namespace manzana::draw {

TEST_CASE("quality goes by the renderer's name") {
  CHECK(quality_for("llvmpipe (LLVM 15.0.6, 256 bits)").samples == 1);
  CHECK(quality_for("Google SwiftShader").samples == 1);
  CHECK(quality_for("NVIDIA GeForce RTX 3060/PCIe/SSE2").samples == 4);
  CHECK(quality_names() == std::vector<std::string>{"fast", "balanced", "accurate", "exact"});
  double coarser = 1000;
  for (const std::string& name : quality_names()) {
    const Quality quality = quality_named(name);
    CHECK(quality.name == name);
    CHECK(quality.tree_error_px > 0);
    CHECK(quality.tree_error_px < coarser);
    coarser = quality.tree_error_px;
  }
  CHECK(quality_named("exact").tree_law == foliage::Law::full);
  CHECK_THROWS_WITH(quality_named("medium"), Catch::Contains("fast, balanced, accurate, exact"));
}

}  // namespace manzana::draw

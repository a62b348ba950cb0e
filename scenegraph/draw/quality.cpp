#include <stdexcept>
#include <string>

#include "gl/context.h"
#include "scenegraph/draw/renderer.h"

namespace manzana::draw {

Quality quality_for(std::string_view renderer) {
  return quality_named(gl::software_renderer(renderer) ? "low" : "high");
}

Quality quality_named(std::string_view name) {
  if (name == "high") return {};
  if (name == "low") return {.samples = 1, .tree_error_px = 2, .car_detail = 0.6, .shadows = true};
  throw std::invalid_argument("no quality is named \"" + std::string(name) + "\": low or high");
}

}  // namespace manzana::draw

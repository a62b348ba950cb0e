#include "apps/bake/visibility.h"

#include <array>
#include <stdexcept>

#include "foliage/gl/cell_visibility.h"
#include "gl/context.h"

namespace manzana::bake {
namespace {

constexpr std::array<std::pair<std::string_view, VisibilityBy>, 5> kNames{{{"best", VisibilityBy::best},
                                                                           {"gpu", VisibilityBy::gpu},
                                                                           {"cpu", VisibilityBy::cpu},
                                                                           {"queries", VisibilityBy::queries},
                                                                           {"none", VisibilityBy::none}}};

std::string by_gl(foliage::PreparedPlant& plant, foliage::CountBy by, const foliage::VisibilityOptions& options) {
  foliage::CellCounterGl counter(plant, by);
  foliage::bake_visibility(plant, options, std::ref(counter));
  return gl::renderer_name() + (by == foliage::CountBy::ids ? ", pictures of cell ids" : ", occlusion queries");
}

std::string by_best(foliage::PreparedPlant& plant, const foliage::VisibilityOptions& options) {
  std::string why;
  try {
    const gl::HeadlessContext context;
    if (!gl::software_renderer()) return by_gl(plant, foliage::CountBy::ids, options);
    why = "GL is software, " + gl::renderer_name();
  } catch (const std::runtime_error& error) {
    why = error.what();
  }
  foliage::bake_visibility(plant, options);
  return "CPU (" + why + ")";
}

}  // namespace

VisibilityBy visibility_named(std::string_view name) {
  for (const auto& [known, by] : kNames)
    if (known == name) return by;
  throw std::invalid_argument("is none of best, gpu, cpu, queries, none");
}

std::string bake_visibility(foliage::PreparedPlant& plant, VisibilityBy by, const std::function<void(double)>& tell) {
  const foliage::VisibilityOptions options{.progress = tell};
  if (by == VisibilityBy::none) return "none";
  if (plant.cells.empty()) return "none: no leaves";
  if (by == VisibilityBy::best) return by_best(plant, options);
  if (by == VisibilityBy::cpu) return foliage::bake_visibility(plant, options), "CPU";
  const gl::HeadlessContext context;
  return by_gl(plant, by == VisibilityBy::gpu ? foliage::CountBy::ids : foliage::CountBy::queries, options);
}

}  // namespace manzana::bake

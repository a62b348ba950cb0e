#pragma once
/// Who counts what can be seen of a plant's cells.
///   std::string by = bake_visibility(plant, VisibilityBy::best, tell);   // "CPU; GL is software (llvmpipe ...)"
#include <functional>
#include <string>
#include <string_view>

#include "foliage/prepared_plant.h"

namespace manzana::bake {

enum class VisibilityBy : std::uint8_t {
  best,     ///< the GPU where a GL 4.5 context can be made on one; else the CPU, which is faster than a GL in software
  gpu,      ///< pictures of cell ids, by whatever GL there is
  cpu,      ///< the same pictures on the CPU
  queries,  ///< [Gumbau 2009] occlusion queries: the reference
  none
};
VisibilityBy visibility_named(std::string_view name);  ///< throws std::invalid_argument

/// Returns who did it. Throws std::runtime_error where a GL is asked for and none can be had.
std::string bake_visibility(foliage::PreparedPlant& plant, VisibilityBy by, const std::function<void(double)>& tell);

}  // namespace manzana::bake

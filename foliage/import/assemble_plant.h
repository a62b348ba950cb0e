#pragma once
/// From triangles of a model file to a Plant: what is branch and what is leaf, and how it hangs together.
#include "foliage/import/classify_triangles.h"

namespace manzana::foliage {

struct PlantReading {
  Plant plant;
  TakenFor taken;                  ///< what was taken for what
  std::vector<std::string> notes;  ///< what was left out, a line each
  std::vector<std::string> files;  ///< that it refers to, by the names that it gives them
};

/// A branch is the triangles of one branch id that hang together, or, without ids, any bark that hangs together; its
/// centre line and its parent come from geometry. A terminal is a connected piece of leaf; its branch is the one whose
/// id it bears, or the nearest. Units are kept; the foot goes to the origin; light as CrownLight has it. Each class
/// wears the image of the material that covers most of its area. Throws std::runtime_error.
PlantReading assemble_plant(const std::string& name, std::span<const SourcePart> parts,
                            std::span<const SourceMaterial> materials);

}  // namespace manzana::foliage

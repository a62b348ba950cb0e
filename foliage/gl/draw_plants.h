#pragma once
/// Draws what extraction chose: three draws, whatever the forest. Light and pictures are the host's: it supplies the
/// pieces of GLSL that foliage/shaders/plant.glsl names.
#include <string_view>
#include <vector>

#include "foliage/gl/extract.h"
#include "foliage/wind.h"
#include "gl/program.h"

namespace manzana::foliage {

/// Without "#version".
struct HostShaders {
  gl::Pieces vertex;                ///< clip_position, plant_light, plant_albedo
  gl::Pieces quads, lines, points;  ///< fragment shaders for what plant_*.vert put out; the first two may call cover()
                                    ///< of foliage/shaders/cover.glsl, which stands before them
  gl::Pieces mosaics;               ///< of packs (foliage/gl/draw_ldm.h): asks mosaic() of foliage/shaders/ldm_*.glsl
};

/// Of so many quads with corners 4 i to 4 i + 3.
gl::Buffer make_quad_indices(std::uint32_t quads);

struct PlantPrograms {
  explicit PlantPrograms(const HostShaders& host);
  gl::Program quads, lines, points;
  gl::VertexArray array;  ///< no attributes; the indices of quads
  gl::Buffer indices;
};

/// To the program in use, as foliage/shaders/sway.glsl has it.
void set_wind(const Wind& wind);

struct DrawPlantsOptions {
  float focal_px = 1000;  ///< pixels of a metre at a distance of a metre
  int samples = 1;        ///< of the framebuffer
  Wind wind;              ///< in the axes of what clip_position() takes
};

/// After extract(), with its bindings in place.
void draw_plants(const PlantPrograms& programs, const PlantStore& store, const Extractor& extractor,
                 const DrawPlantsOptions& options);

}  // namespace manzana::foliage

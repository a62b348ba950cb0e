#pragma once
/// Draws what extraction chose: three draws, whatever the forest. Light and pictures are the host's: it supplies the
/// pieces of GLSL that foliage/shaders/plant.glsl names.
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "foliage/gl/extract.h"
#include "foliage/wind.h"
#include "gl/program.h"

namespace manzana::foliage {

/// Without "#version".
struct HostShaders {
  gl::Pieces vertex;                ///< clip_position, plant_light, plant_albedo
  gl::Pieces quads, lines, points;  ///< fragment shaders for what plant_*.vert put out, which call cover() of
                                    ///< foliage/shaders/cover.glsl
  gl::Pieces mosaics;               ///< of packs (foliage/gl/draw_ldm.h): asks mosaic() of foliage/shaders/ldm_*.glsl
};

/// Of so many quads with corners 4 i to 4 i + 3.
gl::Buffer make_quad_indices(std::uint32_t quads);

/// What shaders of plants ask of the framebuffer: how many samples a pixel has.
std::string define_samples(int samples);

/// Made when they are first drawn with, for that many samples a pixel.
struct PlantPrograms {
  explicit PlantPrograms(HostShaders shaders);

  HostShaders host;
  struct Programs {
    gl::Program quads, lines, points;
  };
  std::map<int, Programs> by_samples;
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
void draw_plants(PlantPrograms& programs, const PlantStore& store, const Extractor& extractor,
                 const DrawPlantsOptions& options);

}  // namespace manzana::foliage

#pragma once
/// Where a picture is drawn: sRGB colour, 32-bit float depth, with or without multisampling.
///   Target target = make_target(1280, 720, 4);
///   bind(target); ...draw...; resolve(target);       // then the picture is in target.picture
#include "gl/handle.h"

namespace manzana::gl {

struct Target {
  int width = 0, height = 0, samples = 1;
  Renderbuffer colour, depth, resolved_colour;
  Framebuffer framebuffer;  ///< drawn into
  Framebuffer resolved;     ///< with samples > 1: the average; else unused
  const Framebuffer& picture() const { return samples > 1 ? resolved : framebuffer; }
};

/// Samples are cut to what the device has. Throws std::runtime_error when the framebuffer is not complete.
Target make_target(int width, int height, int samples);
void bind(const Target& target);     ///< with its viewport
void resolve(const Target& target);  ///< averages in linear light; nothing to do with one sample

}  // namespace manzana::gl

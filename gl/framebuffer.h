#pragma once
/// Where a picture is drawn: sRGB colour, 32-bit float depth, with or without multisampling.
///   Target target = make_target(1280, 720, 4);
///   bind(target); ...draw...; resolve(target);       // then the picture is in target.colour and target.depth
#include "gl/handle.h"

namespace manzana::gl {

struct Target {
  int width = 0, height = 0, samples = 1;
  Renderbuffer sampled_colour, sampled_depth;  ///< with samples > 1
  Texture colour, depth;                       ///< with samples > 1: what they resolve to
  Framebuffer framebuffer;                     ///< drawn into
  Framebuffer resolved;                        ///< with samples > 1: the textures; else unused
  const Framebuffer& picture() const { return samples > 1 ? resolved : framebuffer; }
};

/// Samples are cut to what the device has. Throws std::runtime_error when the framebuffer is not complete.
Target make_target(int width, int height, int samples);
void bind(const Target& target);  ///< with its viewport
/// Averages colour in linear light; nothing to do with one sample.
void resolve(const Target& target);
/// Of each pixel one sample's.
void resolve_depth(const Target& target);

}  // namespace manzana::gl

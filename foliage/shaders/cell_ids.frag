layout(location = 0) in vec2 in_uv;
layout(location = 1) flat in uint in_cell;
layout(location = 2) flat in ivec4 in_box;
layout(location = 0) out uint cell;

layout(binding = 0) uniform usampler2D opaque;
layout(location = 7) uniform uint cells;

// As LeafHoles of foliage/raster.h.
bool hole() {
  ivec2 size = textureSize(opaque, 0);
  ivec2 texel = min(ivec2(fract(in_uv + 1.0) * vec2(size)), size - 1);
  return texelFetch(opaque, texel, 0).r == 0u;
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  if (any(lessThan(at, in_box.xy)) || any(greaterThanEqual(at, in_box.zw))) discard;
  if (in_cell < cells && hole()) discard;  // bark has none
  cell = in_cell;
}

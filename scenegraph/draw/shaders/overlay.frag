// A picture and its depth over those of a host. Alpha is the share of a pixel that is covered.
layout(binding = 0) uniform sampler2D picture;
layout(binding = 1) uniform sampler2D depths;
layout(location = 0) uniform ivec2 corner;        // of the viewport, pixels
layout(location = 1) uniform vec2 depth_mapping;  // scale, offset
layout(location = 2) uniform bool encode;         // else the framebuffer does it

layout(location = 0) out vec4 colour;

vec3 to_srgb(vec3 c) { return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThanEqual(c, vec3(0.0031308))); }

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy) - corner;
  vec4 texel = texelFetch(picture, at, 0);
  if (texel.a <= 0.0) discard;
  // The host blends values as they are: encoded first, then made so thin.
  colour = encode ? vec4(to_srgb(texel.rgb / texel.a) * texel.a, texel.a) : texel;
  gl_FragDepth = clamp(depth_mapping.x * texelFetch(depths, at, 0).r + depth_mapping.y, 0.0, 1.0);
}

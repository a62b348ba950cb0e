// What a fragment shader of a host sees of a mosaic. Its pictures are kept in squares of pages; mip levels of a page
// are those of its squares, as long as no texel beyond a square is filtered in.
layout(location = 0) in vec3 ldm_rel;
layout(location = 1) centroid in vec2 ldm_texel;
layout(location = 2) flat in uvec4 ldm_square;
layout(location = 3) flat in vec3 ldm_normal_x;
layout(location = 4) flat in vec3 ldm_normal_y;
layout(location = 5) flat in vec3 ldm_normal_z;
layout(location = 6) flat in vec3 ldm_share;
layout(location = 7) flat in uvec2 ldm_hash;

layout(binding = 0) uniform sampler2DArray ldm_colours;
layout(binding = 1) uniform sampler2DArray ldm_surfaces;

struct Mosaic {
  vec3 rel, albedo, normal;  // albedo: sRGB
  float shade, leaf, tint;
  float weight;  // what is shown of it, where it is not 1
};

float ldm_side() { return exp2(float(ldm_square.z & 255u)); }

// Within the square.
int ldm_level() {
  vec2 x = dFdx(ldm_texel), y = dFdy(ldm_texel);
  float level = 0.5 * log2(max(max(dot(x, x), dot(y, y)), 1e-12));
  return int(clamp(level + 0.5, 0.0, float(ldm_square.z & 255u)));
}

vec4 ldm_filtered(int level) {
  float texel = exp2(float(level));
  vec2 low = vec2(ldm_square.xy), high = low + ldm_side();
  vec2 at = clamp(ldm_texel, low + 0.5 * texel, high - 0.5 * texel);
  return textureLod(ldm_colours, vec3(at / 256.0, float(ldm_square.w)), float(level));
}

vec4 ldm_colour(int level) {
  vec4 colour = ldm_filtered(level);
  int most = int(ldm_square.z >> 8u);
  return level > most ? vec4(colour.rgb, ldm_filtered(most).a) : colour;
}

vec3 ldm_normal(vec2 code) {
  vec2 p = code * 2.0 - 1.0;
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  vec2 sides = mix(vec2(-1.0), vec2(1.0), greaterThanEqual(p, vec2(0.0)));
  if (n.z < 0.0) n.xy = (1.0 - abs(p.yx)) * sides;
  return normalize(vec3(dot(ldm_normal_x, n), dot(ldm_normal_y, n), dot(ldm_normal_z, n)));
}

Mosaic ldm_mosaic(vec3 srgb, int level) {
  ivec2 last = ivec2(ldm_square.xy) + int(ldm_side()) - 1;
  ivec2 at = clamp(ivec2(ldm_texel), ivec2(ldm_square.xy), last) >> level;
  vec4 surface = texelFetch(ldm_surfaces, ivec3(at, int(ldm_square.w)), level);
  float shade = floor(surface.w * 255.0 + 0.5), leaf = step(127.5, shade);
  return Mosaic(ldm_rel, srgb, ldm_normal(surface.xy), (shade - 128.0 * leaf) / 127.0, leaf, ldm_share.z, 1.0);
}

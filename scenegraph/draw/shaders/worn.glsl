// Pictures that surfaces wear, in squares of pages. A square's levels are those of its page, as far as it has some; what
// is looked up keeps half a texel from its edges, so that neighbours do not show.
layout(std430, binding = 0) readonly buffer WornRows { WornData worn_rows[]; };
layout(binding = 0) uniform sampler2DArray picture_pages;

const uint kNoWrap = 0u, kRepeat = 1u, kMirror = 2u, kBorder = 4u;

vec2 folded(vec2 at, uint wrap) {
  if (wrap == kRepeat) return fract(at);
  if (wrap == kMirror) return 1.0 - abs(2.0 * fract(0.5 * at) - 1.0);
  return clamp(at, 0.0, 1.0);
}

// Light times alpha, and alpha.
vec4 beyond_edge(uint wrap, uint border) {
  vec4 c = vec4(uvec4(border, border >> 8, border >> 16, border >> 24) & 255u) * (1.0 / 255.0);
  return wrap == kBorder ? vec4(from_srgb(c.rgb) * c.a, c.a) : vec4(0.0);
}

// What shows of a picture, 1 to row's count, on a surface of that colour: this alone where the picture is not held.
vec3 worn_colour(vec3 base, vec2 at, uint texture_number) {
  vec2 along_x = dFdx(at), along_y = dFdy(at);
  uint row = texture_number - 1u;
  if (row >= uint(worn_rows.length())) return base;
  WornData worn = worn_rows[row];
  if (worn.how.x == 0u) return base;
  float step = max(length(along_x * worn.part.zw), length(along_y * worn.part.zw));
  float level = clamp(log2(max(step, 1e-9)) + worn.place.w, 0.0, worn.place.w);
  float edge = min(0.5 * exp2(ceil(level) - worn.place.w), 0.5);
  vec2 inside = clamp((folded(at, worn.how.y) - worn.part.xy) * worn.part.zw, edge, 1.0 - edge);
  vec4 seen = textureLod(picture_pages, vec3(worn.place.xy + worn.place.z * inside, float(worn.how.x - 1u)), level);
  bool beyond = at != clamp(at, 0.0, 1.0);
  if (beyond && (worn.how.y == kNoWrap || worn.how.y == kBorder)) seen = beyond_edge(worn.how.y, worn.how.z);
  return base * (1.0 - seen.a) + seen.rgb;
}

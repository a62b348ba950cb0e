// What the city's fragment shaders are given, by city.vert.
layout(location = 0) in vec3 rel;
layout(location = 1) in vec3 smooth_normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec3 place;
layout(location = 4) flat in vec3 albedo;
layout(location = 5) flat in uvec2 kind;
layout(location = 0) out vec4 colour;

// How much of a pixel of width w about x the interval [a, b] covers: a box filter.
float cover(float x, float w, float a, float b) {
  return clamp((min(x + 0.5 * w, b) - max(x - 0.5 * w, a)) / w, 0.0, 1.0);
}

// Below: x and y in L, relative to the eye.
vec2 on_ground() { return rel.xy - place.z * frame.up.xy; }

// What foliage/shaders/plant.glsl asks of its host. Trees are lit at their vertices: leaves are small, pixels are many.
vec4 clip_position(vec3 rel) { return frame.view_projection * vec4(rel, 1.0); }

vec3 plant_film(vec3 arriving) { return film(arriving); }

vec3 plant_albedo(vec3 srgb) { return from_srgb(srgb); }

void plant_light(vec3 rel, vec3 n, float shade, float leaf, float tint, out vec3 light, out vec3 air) {
  float towards = dot(n, frame.sun.xyz);
  float lit = max(towards, 0.0) + leaf * (0.16 + 0.22 * max(-towards, 0.0));  // leaves let light through
  float h = 0.5 + 0.5 * dot(n, frame.up.xyz);
  vec3 ambient = mix(frame.ground_light.rgb, frame.sky_light.rgb, h) * (0.3 + 0.7 * shade);
  light = ambient + frame.sun_light.rgb * (lit * (0.25 + 0.75 * shade * shade));
  light *= mix(vec3(1.0), mix(vec3(0.72, 0.84, 0.80), vec3(1.12, 1.0, 0.72), tint), leaf);
  float d = length(rel), clear = exp2(-d * frame.fog.x);
  light *= clear;
  air = air_light(rel / d) * (1.0 - clear);
}

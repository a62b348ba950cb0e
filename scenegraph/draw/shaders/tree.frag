layout(location = 0) centroid in vec3 uv;
layout(location = 1) centroid in vec3 light;
layout(location = 2) centroid in vec3 air;
layout(location = 3) flat in uint hash;
layout(location = 0) out vec4 colour;

layout(binding = 0) uniform sampler2DArray plants;

void main() {
  vec4 texel = texture(plants, uv);
  // Near, alpha is sharpened to about one pixel about its half, or cut there.  [Golus 2017, "Anti-aliased Alpha Test"]
  float edge = samples > 1u ? clamp((texel.a - 0.5) / max(fwidth(texel.a), 1e-4) + 0.5, 0.0, 1.0) : step(0.5, texel.a);
  cover(mix(edge, texel.a, blurred(uv.xy, 256.0)), hash);
  colour = vec4(film(from_srgb(texel.rgb) * light + air), 1.0);
}

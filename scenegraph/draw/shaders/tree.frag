layout(location = 0) in vec3 uv;
layout(location = 1) in vec3 light;
layout(location = 2) in vec3 air;
layout(location = 0) out vec4 colour;

layout(binding = 0) uniform sampler2DArray plants;
layout(location = 1) uniform float alpha_to_coverage;

void main() {
  vec4 texel = texture(plants, uv);
  // With coverage, alpha is sharpened to about one pixel about its half.  [Golus 2017, "Anti-aliased Alpha Test"]
  float alpha = mix(texel.a, clamp((texel.a - 0.5) / max(fwidth(texel.a), 1e-4) + 0.5, 0.0, 1.0), alpha_to_coverage);
  if (texel.a < mix(0.5, 0.004, alpha_to_coverage)) discard;
  colour = vec4(film(from_srgb(texel.rgb) * light + air), alpha);
}

layout(location = 0) in vec3 rel;
layout(location = 1) in vec3 smooth_normal;
layout(location = 2) in vec3 uv;
layout(location = 3) in vec3 shade;
layout(location = 0) out vec4 colour;

layout(binding = 0) uniform sampler2DArray plants;
layout(location = 0) uniform float alpha_to_coverage;

void main() {
  vec4 texel = texture(plants, uv);
  // With coverage, alpha is sharpened to about one pixel about its half.  [Golus 2017, "Anti-aliased Alpha Test"]
  float alpha = mix(texel.a, clamp((texel.a - 0.5) / max(fwidth(texel.a), 1e-4) + 0.5, 0.0, 1.0), alpha_to_coverage);
  if (texel.a < mix(0.5, 0.004, alpha_to_coverage)) discard;
  float leaf = shade.y;
  vec3 n = normalize(smooth_normal);
  vec3 base = texel.rgb * mix(vec3(1.0), mix(vec3(0.82, 0.92, 0.85), vec3(1.2, 1.08, 0.8), shade.z), leaf);
  float towards = dot(n, frame.sun.xyz);
  float lit = max(towards, 0.0) + leaf * (0.22 + 0.25 * max(-towards, 0.0));  // leaves let light through
  float h = 0.5 + 0.5 * dot(n, frame.up.xyz);
  vec3 ambient = mix(frame.ground_light.rgb, frame.sky_light.rgb, h) * (0.35 + 0.65 * shade.x);
  vec3 light = ambient + frame.sun_light.rgb * lit * (0.3 + 0.7 * shade.x * shade.x);
  colour = vec4(picture(base * light, rel).rgb, alpha);
}

layout(location = 0) in vec3 rel;
layout(location = 1) in vec3 smooth_normal;
layout(location = 2) flat in vec4 base;
layout(location = 3) flat in float share;
layout(location = 0) out vec4 colour;

void main() {
  gl_SampleMask[0] = ~0;
  if (share < 1.0) keep_share(share);
  vec3 n = normalize(smooth_normal);
  vec3 d = normalize(rel);
  float miss = 1.0 - clamp(-dot(d, n), 0.0, 1.0);
  float fresnel = base.a * (0.06 + 0.94 * miss * miss * miss * miss);
  vec3 mirrored = reflect(d, n);
  float above = smoothstep(-0.1, 0.15, dot(mirrored, frame.up.xyz));
  vec3 outside = mix(frame.ground_light.rgb * 0.5, sky_light(mirrored), above);
  float c = max(dot(mirrored, frame.sun.xyz), 0.0);
  float c4 = c * c * c * c;
  float c16 = c4 * c4 * c4 * c4;
  vec3 glint = frame.sun_light.rgb * (base.a * 0.9 * c16 * c16 * c16);
  colour = picture(mix(base.rgb * diffuse_light(n, 0.9), outside, fresnel) + glint, rel);
}

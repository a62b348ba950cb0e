// The sky: air, sun, some clouds.
layout(location = 0) in vec3 ray;
layout(location = 0) out vec4 colour;

void main() {
  vec3 d = normalize(ray);
  float e = dot(d, frame.up.xyz);
  vec3 sky = sky_light(d);

  vec2 p = vec2(dot(d, frame.ground_x.xyz), dot(d, frame.ground_y.xyz)) / (max(e, 0.0) + 0.12) * 1.7 + 37.0;
  float n = 0.55 * value_noise(p) + 0.28 * value_noise(p * 2.3 + 11.0) + 0.17 * value_noise(p * 5.1 + 23.0);
  float dense = smoothstep(0.5, 0.78, n) * smoothstep(0.02, 0.25, e);
  float c = max(dot(d, frame.sun.xyz), 0.0);
  float c4 = c * c * c * c;
  vec3 lit = frame.sun_light.rgb * (0.62 + 0.3 * c4) + frame.sky_light.rgb * 0.5;
  sky = mix(sky, lit * mix(1.0, 0.80, dense), dense * 0.8);

  sky += frame.sun_light.rgb * (exp2((c - 1.0) * 900.0) * 1.2 + smoothstep(0.99992, 0.99996, c) * 12.0);
  colour = vec4(film(sky), 1.0);
}

// What no surface covers below the horizon: the Earth's own ground.
layout(location = 0) in vec3 ray;
layout(location = 0) out vec4 colour;

void main() {
  vec3 d = normalize(ray);
  float t = earth_distance(d);
  vec2 p = vec2(frame.ground_x.w, frame.ground_y.w) + vec2(dot(d, frame.ground_x.xyz), dot(d, frame.ground_y.xyz)) * t;
  float pixel = t * 0.002 / max(0.02, -dot(d, frame.up.xyz));
  float coarse = value_noise(p * 0.015625) - 0.5;
  float middle = (value_noise(p * 0.25) - 0.5) * (1.0 - smoothstep(2.0, 8.0, pixel));
  float fine = (value_noise(p * 5.0) - 0.5) * (1.0 - smoothstep(0.1, 0.4, pixel));
  vec3 base = mix(vec3(0.105, 0.130, 0.050), vec3(0.165, 0.155, 0.085), clamp(0.45 + coarse + 0.5 * middle, 0.0, 1.0));
  base *= (1.0 + 0.3 * middle + 0.35 * fine);
  base = photographed(base, d.xy * t);
  vec3 ground = base * diffuse_light(frame.up.xyz, 0.9);
  colour = vec4(film(mix(air_light(d), ground, exp2(-t * frame.fog.x))), 1.0);
}

// What no surface covers: above the horizon the sky, below it the Earth's own ground, a sphere without end or hole.
layout(location = 0) in vec3 ray;
layout(location = 0) out vec4 colour;

const float kEarth = 6371008.8;

// Distance to the Earth along d, metres; negative: missed. Scaled by the Earth's radius, and the nearer root taken by the
// quotient that does not cancel.
float earth_distance(vec3 d) {
  float h = max(frame.up.w, 0.3) / kEarth;
  float b = (1.0 + h) * dot(d, frame.up.xyz);
  float q = h * (2.0 + h);
  float disc = b * b - q;
  return b < 0.0 && disc >= 0.0 ? kEarth * q / (sqrt(disc) - b) : -1.0;
}

vec3 ground_colour(vec3 d, float t) {
  vec2 p = vec2(frame.ground_x.w, frame.ground_y.w) + vec2(dot(d, frame.ground_x.xyz), dot(d, frame.ground_y.xyz)) * t;
  float pixel = t * 0.002 / max(0.02, -dot(d, frame.up.xyz));
  float coarse = value_noise(p * 0.015625) - 0.5;
  float middle = (value_noise(p * 0.25) - 0.5) * (1.0 - smoothstep(2.0, 8.0, pixel));
  vec3 base = mix(vec3(0.105, 0.125, 0.048), vec3(0.165, 0.15, 0.085), clamp(0.45 + coarse + 0.5 * middle, 0.0, 1.0));
  return base * (1.0 + 0.3 * middle) * diffuse_light(frame.up.xyz, 0.9);
}

vec3 clouds(vec3 d, vec3 sky) {
  float e = dot(d, frame.up.xyz);
  vec2 p = vec2(dot(d, frame.ground_x.xyz), dot(d, frame.ground_y.xyz)) / (max(e, 0.0) + 0.12) * 1.7 + 37.0;
  float n = 0.55 * value_noise(p) + 0.28 * value_noise(p * 2.3 + 11.0) + 0.17 * value_noise(p * 5.1 + 23.0);
  float dense = smoothstep(0.5, 0.78, n) * smoothstep(0.02, 0.25, e);
  float c = max(dot(d, frame.sun.xyz), 0.0);
  vec3 lit = frame.sun_light.rgb * (0.42 + 0.3 * c * c * c * c) + frame.sky_light.rgb * 0.35;
  return mix(sky, lit * mix(1.0, 0.78, dense), dense * 0.75);
}

void main() {
  vec3 d = normalize(ray);
  float t = earth_distance(d);
  float c = max(dot(d, frame.sun.xyz), 0.0);
  vec3 sky = clouds(d, sky_light(d));
  float glow = exp2((c - 1.0) * 900.0) * 1.2 + smoothstep(0.99992, 0.99996, c) * 12.0;
  sky += frame.sun_light.rgb * glow;
  vec3 ground = mix(air_light(d), ground_colour(d, max(t, 0.0)), exp2(-t * frame.fog.x));
  colour = vec4(film(t > 0.0 ? ground : sky), 1.0);
}

// Everything else that one walks on: slabs, paths, grass, soil, sand, concrete.
const uint kPavement = 4u, kPath = 5u, kFarmland = 9u;

void main() {
  keep_own_share();
  vec3 n = normalize(smooth_normal);
  vec2 p = place.xy;
  float pixel = max(fwidth(p.x), fwidth(p.y));
  bool green = kind.x >= 6u && kind.x <= 9u;
  float coarse = value_noise(p * 0.11) - 0.5;
  float middle = (value_noise(p * 1.3) - 0.5) * (1.0 - smoothstep(0.3, 0.9, pixel));
  float fine = (value_noise(p * 13.0) - 0.5) * (1.0 - smoothstep(0.03, 0.12, pixel));

  vec2 slab = fract(uv * 1.4);
  vec2 w = max(fwidth(uv) * 1.4, 1e-5);
  float joint = max(cover(slab.x, w.x, 0.0, 0.035), cover(slab.y, w.y, 0.0, 0.035));
  joint *= (kind.x == kPavement ? 1.0 : 0.0) * (1.0 - smoothstep(0.3, 0.7, max(w.x, w.y)));
  float furrow = kind.x == kFarmland ? 0.1 * sin(p.x * 2.2 + 0.6 * coarse) * (1.0 - smoothstep(0.4, 1.2, pixel)) : 0.0;

  float rough = green ? 1.0 : 0.3;
  float tone = 1.0 + rough * (0.34 * coarse + 0.30 * middle + 0.36 * fine) + furrow - 0.22 * joint;
  vec3 base = albedo * tone * (green ? vec3(0.82, 0.74, 0.78) : vec3(1.0));
  base = green ? mix(base, base * vec3(1.18, 1.00, 0.66), clamp(0.5 + 1.4 * coarse + 0.6 * middle, 0.0, 1.0) * 0.55) : base;
  base = photographed(base, on_ground());
  colour = picture(base * diffuse_light(n, 0.9), rel);
}

// Walls: windows by bay and storey, a ground floor of shops and doors, bands between storeys. No texture: rectangles
// filtered by the size of a pixel, and where a bay is smaller than that, their mean.
const vec3 kFrame = vec3(0.50, 0.49, 0.46);
const vec3 kCurtain = vec3(0.55, 0.52, 0.46);

float box(vec2 f, vec2 w, vec4 r) { return cover(f.x, w.x, r.x, r.z) * cover(f.y, w.y, r.y, r.w); }

void main() {
  keep_own_share();
  vec3 n = normalize(smooth_normal);
  vec2 w = max(fwidth(uv), 1e-5);
  float flat_wall = (uv.x == 0.0 && uv.y == 0.0) ? 1.0 : 0.0;
  float near = (1.0 - flat_wall) * (1.0 - smoothstep(0.4, 0.8, max(w.x, w.y)));

  vec2 cell = floor(uv);
  vec2 f = uv - cell;
  float h = hash01(ivec2(cell), kind.y);
  float house = hash01(kind.y);
  float shop = (cell.y < 0.5 && house > 0.35) ? 1.0 : 0.0;
  float door = (cell.y < 0.5 && h < 0.22) ? 1.0 : 0.0;

  float half_width = mix(0.22, 0.32, house);
  vec4 r = vec4(0.5 - half_width, 0.26, 0.5 + half_width, 0.86);
  r = mix(r, vec4(0.07, 0.10, 0.93, 0.80), shop);
  r = mix(r, vec4(0.28, 0.0, 0.72, 0.78), door);
  float opening = box(f, w, r);
  float glass = box(f, w, r + vec4(0.03, 0.03, -0.03, -0.03));
  glass -= shop * (box(f, w, vec4(0.49, r.y, 0.51, r.w)) + box(f, w, vec4(r.x, 0.64, r.z, 0.665))) * glass;
  glass -= (1.0 - shop) * box(f, w, vec4(0.488, r.y, 0.512, r.w)) * glass;
  float sill = box(f, w, vec4(r.x - 0.04, r.y - 0.045, r.z + 0.04, r.y)) * (1.0 - shop) * (1.0 - door);
  float band = cover(f.y, w.y, 0.0, 0.035) * 0.5 + cover(f.y, w.y, 0.97, 1.0);

  // The mean over a bay, for a wall too far away to have windows.
  const float kMeanGlass = 0.26;
  glass = mix(kMeanGlass * (1.0 - flat_wall), glass, near);
  opening = mix(kMeanGlass * 1.2 * (1.0 - flat_wall), opening, near);
  float curtain = mix(0.35, h > 0.62 ? 0.8 * smoothstep(0.35, 0.75, f.y + h - 0.75) : 0.0, near);

  float contact = 0.72 + 0.28 * clamp(place.z * 0.2, 0.0, 1.0);
  vec3 light = diffuse_light(n, contact);
  vec3 wall = albedo * (1.0 - 0.25 * near * band) * (0.96 + 0.08 * house);
  wall = mix(wall, min(albedo * 1.3, vec3(0.7)), near * sill);
  wall = mix(wall, kFrame, clamp(opening - glass, 0.0, 1.0));

  vec3 d = normalize(rel);
  vec3 mirrored = reflect(d, n);
  float facing = clamp(-dot(d, n), 0.0, 1.0);
  float fresnel = 0.12 + 0.75 * pow(1.0 - facing, 4.0);
  float above = smoothstep(-0.05, 0.25, dot(mirrored, frame.up.xyz));
  vec3 outside = mix(frame.ground_light.rgb * 0.6, sky_light(mirrored), above);
  vec3 inside = mix(vec3(0.02, 0.022, 0.026), kCurtain * light * 0.35, curtain * (1.0 - shop));
  float goods = 0.35 + 0.65 * fract(h * 7.3 + floor(f.x * 5.0) * 0.377);
  inside += vec3(0.20, 0.16, 0.11) * (shop * (1.0 - door) * (0.12 + 0.5 * goods * smoothstep(0.7, 0.15, f.y))) * near;
  inside += vec3(0.22, 0.15, 0.07) * (h > 0.95 ? near : 0.0);
  vec3 pane = mix(inside, outside, fresnel);
  colour = picture(mix(wall * light, pane, glass), rel);
}

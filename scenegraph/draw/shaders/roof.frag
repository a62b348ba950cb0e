// Roofs: rows of tiles on a slope, gravel on the flat; uv in metres along the eaves and up the slope.
void main() {
  keep_own_share();
  vec3 n = normalize(smooth_normal);
  vec2 w = max(fwidth(uv), 1e-5);
  float sloped = 1.0 - smoothstep(0.97, 0.995, dot(n, frame.up.xyz));
  float rows_near = 1.0 - smoothstep(0.10, 0.25, w.y);
  float row = fract(uv.y * 3.0);
  float tiles = sloped * rows_near * (0.22 * row - 0.11 + (hash01(ivec2(floor(uv * vec2(4.0, 3.0))), 7u) - 0.5) * 0.16);
  float patches = value_noise(place.xy * 0.35) - 0.5;
  float gravel = (1.0 - sloped) * (hash01(ivec2(floor(place.xy * 12.0)), 3u) - 0.5) * 0.3 *
                 (1.0 - smoothstep(0.02, 0.08, max(fwidth(place.x), fwidth(place.y))));
  vec3 base = albedo * (1.0 + tiles + gravel + 0.14 * patches);
  colour = picture(base * diffuse_light(n, 1.0), rel);
}

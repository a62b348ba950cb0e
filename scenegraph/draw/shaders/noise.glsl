// Counter hashes and value noise, equal on every device: integers only until the end.
uint hash(uint x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ (x >> 16);
}
float hash01(uint x) { return float(hash(x) >> 8) * (1.0 / 16777216.0); }
float hash01(ivec2 cell, uint seed) { return hash01(uint(cell.x) * 0x9e3779b9u ^ uint(cell.y) * 0x85ebca6bu ^ seed); }

// 0..1, with a lattice of unit cells that repeats every 1024 of them.
float value_noise(vec2 p) {
  vec2 base = floor(p);
  vec2 f = p - base;
  f = f * f * (3.0 - 2.0 * f);
  ivec2 a = ivec2(base) & 1023;
  ivec2 b = (a + 1) & 1023;
  float bottom = mix(hash01(a, 0u), hash01(ivec2(b.x, a.y), 0u), f.x);
  float top = mix(hash01(ivec2(a.x, b.y), 0u), hash01(b, 0u), f.x);
  return mix(bottom, top, f.y);
}

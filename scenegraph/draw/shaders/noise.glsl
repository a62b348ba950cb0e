// Hashes and value noise. Integers where a value must not differ between devices (windows), floats where it may and has
// to be quick (noise).
uint hash(uint x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ (x >> 16);
}
float hash01(uint x) { return float(hash(x) >> 8) * (1.0 / 16777216.0); }
float hash01(ivec2 cell, uint seed) { return hash01(uint(cell.x) * 0x9e3779b9u ^ uint(cell.y) * 0x85ebca6bu ^ seed); }

// 0..1 at the four corners of a cell: x of the low row, y, then the high row.  [Hoskins 2014, "Hash without sine"]
vec4 corner_hashes(vec2 cell) {
  vec4 x = fract(vec4(cell.x, cell.x + 1.0, cell.x, cell.x + 1.0) * 0.1031);
  vec4 y = fract(vec4(cell.y, cell.y, cell.y + 1.0, cell.y + 1.0) * 0.1137);
  vec4 s = x * (y + 33.33) + y * (x + 33.33) + x * (x + 33.33);
  x += s;
  y += s;
  return fract((x + y) * (x + 17.17));
}

// 0..1, with unit cells.
float value_noise(vec2 p) {
  vec2 base = floor(p);
  vec2 f = p - base;
  f = f * f * (3.0 - 2.0 * f);
  vec4 h = corner_hashes(base);
  return mix(mix(h.x, h.y, f.x), mix(h.z, h.w, f.x), f.y);
}

// foliage/octahedral.cpp in GLSL, to the bit: see there.
struct GridWeights {
  uvec3 vertex, weight;
};

float flushed(float v) { return abs(v) < 7.888609052210118e-31f ? 0.0f : v; }

int rounded_share(float a, float s, int whole) {
  precise float limit = float(whole) * a + 0.5f * s;
  int q = int(limit / s);
  precise float now = float(q) * s, more = float(q + 1) * s;
  if (now > limit) --q;
  else if (more <= limit) ++q;
  return min(q, whole);
}

GridWeights weights_at(uint side, int half_side, int x, int y) {
  uint from_x = uint(half_side + x), from_y = uint(half_side + y);
  uint i = min(from_x / 256u, side - 2u), j = min(from_y / 256u, side - 2u);
  uint f = from_x - 256u * i, g = from_y - 256u * j, corner = j * side + i;
  bool right = 2u * i + 1u >= side - 1u, up = 2u * j + 1u >= side - 1u;
  uint low_right = corner + 1u, high_left = corner + side, high_right = corner + side + 1u;
  GridWeights grid;
  if (right == up) {
    bool low = f + g <= 256u;
    grid.vertex = low ? uvec3(corner, low_right, high_left) : uvec3(high_right, low_right, high_left);
    grid.weight = low ? uvec3(256u - f - g, f, g) : uvec3(f + g - 256u, 256u - g, 256u - f);
  } else {
    bool low = f >= g;
    grid.vertex = uvec3(corner, low ? low_right : high_left, high_right);
    grid.weight = low ? uvec3(256u - f, f - g, g) : uvec3(256u - g, g - f, f);
  }
  return grid;
}

GridWeights grid_weights(uint side, vec3 direction) {
  int half_side = int((side - 1u) * 128u);
  float x = flushed(direction.x), y = flushed(direction.y), z = flushed(direction.z);
  precise float sum = abs(x) + abs(y);
  precise float all = sum + abs(z);
  if (!(all > 0.0f) || !(all < 1.2676506002282294e30f)) return weights_at(side, half_side, 0, 0);
  int a = rounded_share(abs(x), all, half_side), b = rounded_share(abs(y), all, half_side);
  if (z < 0.0f) {
    int folded = half_side - b;
    b = half_side - a;
    a = folded;
  }
  return weights_at(side, half_side, x < 0.0f ? -a : a, y < 0.0f ? -b : b);
}

// [Jarzynski, Olano 2020, "Hash functions for GPU rendering", PCG]
uint mixed(uint x) {
  uint state = x * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}

float fraction_of(uint hash) { return float(hash >> 8u) * 5.9604644775390625e-8f; }  // [0, 1)

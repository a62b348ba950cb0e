// Alpha as a share of a pixel's samples: SAMPLES of them. So leaves behind each other add up in any order, as they do not
// where equal alpha means equal samples.
const uint samples = SAMPLES;

// Of alpha times the samples, one more by chance (noise: in [0, 1)), from one on that the hash chooses.
uint samples_of(float alpha, float noise, uint hash) {
  uint n = min(uint(alpha * float(samples) + noise), samples);
  uint first = (hash >> 16u) % samples, mask = ((1u << n) - 1u) << first;
  return (mask | (mask >> samples)) & ((1u << samples) - 1u);
}

float noise_of(uint hash) { return float(hash & 0xffffu) * (1.0 / 65536.0); }

// For fragment shaders of plants: alpha as a share of the pixel's samples. Which ones is drawn anew for each primitive
// and pixel, so that leaves behind each other add up, as they do not where equal alpha means equal samples.
layout(location = 1) uniform uint samples;

uint tree_samples();

// [Jimenez 2014, "Next generation post processing in Call of Duty", interleaved gradient noise]
float pixel_noise(uint hash) {
  float grid = 52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)));
  return fract(grid + float(hash & 0xffffu) * (1.0 / 65536.0));
}

// Of the samples those that are the tree's own: tree_samples().
void cover(float alpha, uint hash) {
  float noise = pixel_noise(hash);
  uint n = min(uint(alpha * float(samples) + noise), samples);
  uint first = (hash >> 16u) % samples, mask = ((1u << n) - 1u) << first;
  mask = (mask | (mask >> samples)) & ((1u << samples) - 1u) & tree_samples();
  if (mask == 0u) discard;
  if (samples > 1u) gl_SampleMask[0] = int(mask);
}

// How far a picture of so many texels is from being seen sharply: 0 while its leaves are larger than a few pixels, 1
// where only their mean alpha is left to see.
float blurred(vec2 uv, float texels) {
  vec2 x = dFdx(uv) * texels, y = dFdy(uv) * texels;
  float level = 0.5 * log2(max(max(dot(x, x), dot(y, y)), 1e-12));
  return clamp(level - 3.5, 0.0, 1.0);
}

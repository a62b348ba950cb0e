// For fragment shaders of plants: which samples of a pixel they cover.
uint tree_samples();

// Of samples_of() those that are the tree's own. Software pays for each "discard", so there is none where the mask does
// as well.
void cover(uint mask) {
  mask &= tree_samples();
  if (samples == 1u && mask == 0u) discard;
  gl_SampleMask[0] = int(mask);
}

// Drawn anew for each primitive and pixel.
// [Jimenez 2014, "Next generation post processing in Call of Duty", interleaved gradient noise]
void cover(float alpha, uint hash) {
  float grid = 52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)));
  cover(samples_of(alpha, fract(grid + noise_of(hash)), hash));
}

// How far a picture of so many texels is from being seen sharply: 0 while its leaves are larger than a few pixels, 1
// where only their mean alpha is left to see.
float blurred(vec2 uv, float texels) {
  vec2 x = dFdx(uv) * texels, y = dFdy(uv) * texels;
  float level = 0.5 * log2(max(max(dot(x, x), dot(y, y)), 1e-12));
  return clamp(level - 3.5, 0.0, 1.0);
}

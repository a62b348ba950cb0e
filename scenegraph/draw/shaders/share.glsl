// Between two levels each sample of a pixel shows one of them: below 0 those that the other leaves.
// [numerics 13.4; Jimenez 2014, interleaved gradient noise]
void keep_share(float share) {
  float number = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  int samples = max(gl_NumSamples, 1), mask = 0;
  for (int s = 0; s < samples; ++s) {
    float part = fract(number + float(s) / float(samples));
    if (share > 0.0 ? part < share : part >= -share) mask |= 1 << s;
  }
  if (mask == 0) discard;
  gl_SampleMask[0] = mask;
}

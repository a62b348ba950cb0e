// Each sample of a pixel shows one of a tree's sides and levels: those whose share of [0, 1) holds the sample's number.
// So a crown is as opaque on the way from one to the next as at either end, in any order.  [numerics 13.4]
const uint samples = SAMPLES;

const uint kTile = 8u;

// Drawn anew for every few pixels, so that two mosaics hide as much of each other as chance would have it.
uint hash_of_tile(uint hash) {
  uvec2 tile = uvec2(gl_FragCoord.xy) / kTile;
  return mixed(hash + mixed(tile.x + mixed(tile.y)));
}

// Spread more evenly over neighbours.  [Jimenez 2014, interleaved gradient noise]
float even_number(uint hash) {
  return fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))) + fraction_of(hash));
}

// Both numbers are spread evenly over the pixel's samples. They must not depend on each other.
uint shown_samples(float alpha) {
  uint hash = hash_of_tile(ldm_hash.y), mask = 0u, turn = hash & 31u;
  float choice = pixel_number(ldm_hash.x), covered = even_number(hash);
  for (uint s = 0u; s < samples; ++s) {
    float part = sample_number(choice, s, samples);
    float cut = (float((s * 3u + turn) % samples) + covered) / float(samples);
    if (part >= ldm_share.x && part < ldm_share.y && cut < alpha) mask |= 1u << s;
  }
  return mask;
}

Mosaic mosaic() {
  int level = ldm_level();
  vec4 colour = ldm_colour(level);
  uint mask = shown_samples(colour.a);
  if (samples == 1u && mask == 0u) discard;  // software pays for it
  if (samples > 1u) gl_SampleMask[0] = int(mask);
  return ldm_mosaic(colour.rgb, level);
}

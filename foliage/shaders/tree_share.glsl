// A tree is shown in two ways at once while one gives way to the other: each sample of a pixel belongs to one of them, by
// a number of its own in [0, 1). So a crown is as opaque on the way as at either end.  [numerics 13.4]
float pixel_number(uint hash) {
  uvec2 at = uvec2(gl_FragCoord.xy);
  return fraction_of(mixed(hash + mixed(at.x + mixed(at.y))));
}

float sample_number(float number, uint s, uint samples) { return fract(number + float(s) / float(samples)); }

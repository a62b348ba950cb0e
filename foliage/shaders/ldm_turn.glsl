// A vector across a side, when the side is turned to the eye; `towards` and `to_eye`: unit, to_eye 0: it is not turned.
// Compiled as C++ too (foliage/ldm_cover.cpp). Pictures that are turned neither show what lay behind their edges nor
// hide what it would: `grown` makes up for it, the more the farther they turn.
vec3 turned(vec3 across, vec3 towards, vec3 to_eye, float grown) {
  if (to_eye == vec3(0.0f)) return across;
  float cosine = dot(towards, to_eye);
  vec3 there = across - (towards + to_eye) * (dot(across, to_eye) / max(1.0f + cosine, 0.1f));
  return there * (1.0f + grown * (1.0f - cosine));
}

// The coarsest mip level whose alpha is that of a mosaic, so many pixels of its block across and along, of a picture
// that is kept so much shrunk: coarser texels are of what lies beside it, too, and a crown of a few pixels would thin
// out.
uint ldm_most_level(uint across, uint along, uint shrink) {
  int level = findMSB(min(across, along)) - 2 - int(shrink);
  return uint(max(level, 0));
}

// One side and level of each tree, blended in its order into a picture of its own, times its weight; such pictures are
// added up. What is behind is dimmed by alpha alone.
layout(location = 0, index = 1) out vec4 ldm_hides;

Mosaic mosaic() {
  int level = ldm_level();
  vec4 colour = ldm_colour(level);
  if (colour.a == 0.0) discard;
  Mosaic seen = ldm_mosaic(colour.rgb, level);
  seen.weight = colour.a * (ldm_share.y - ldm_share.x);
  ldm_hides = vec4(colour.a);
  return seen;
}

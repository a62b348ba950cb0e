// How wind moves a place of a plant. The trunk bends, a branch swings on it, more so the finer it is, each tree and each
// bough in its own time. At most kMostSway (foliage/wind.h) of the tree's height, of wind of strength 1.
//   p: in the plant's frame; height: of the plant there, metres: that of the tree; level: 0 trunk, 1 finest twigs
layout(location = 2) uniform vec4 wind;  // where it blows to, level, times its strength; w: time, seconds

vec3 sway(vec3 p, float height, float metres, uint hash, float level) {
  float up = clamp(p.z / height, 0.0, 1.0), phase = float(hash >> 8u) * (6.2831853 / 16777216.0);
  float trunk = up * up * (0.6 + 0.3 * sin(0.9 * wind.w + phase) + 0.1 * sin(2.3 * wind.w + 2.0 * phase));
  float bough = level * up * sin(2.9 * wind.w + phase + dot(p, vec3(1.3, 1.7, 0.9)));
  return wind.xyz * (metres * (0.012 * trunk + 0.006 * bough));
}

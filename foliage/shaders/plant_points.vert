// A square of pixels that stands for leaves.
struct LeafPoint {
  vec4 position_area;
  uvec4 rest;  // normal, sRGB colour and contrast, shade as floatBitsToUint
};
layout(std430, binding = 17) readonly buffer Points { LeafPoint points[]; };

layout(location = 0) out vec3 out_colour;
layout(location = 1) flat out uint out_samples;
layout(location = 7) flat out uvec2 out_share;

// By what the scales of a tree multiply areas, as they look from there: across times along its axis from a side, across
// twice from above.
float scaled_area(TreeRecord tree, vec3 rel) {
  vec2 s = scales2(tree);
  vec3 axis = vec3(tree.row_x.z, tree.row_y.z, tree.row_z.z);
  float along = dot(axis, rel), up2 = min(along * along / max(s.y * dot(rel, rel), 1e-30), 1.0);
  return sqrt(s.x * mix(s.y, s.x, up2));
}

void main() {
  uint slot = uint(gl_VertexID);
  uvec2 group = groups[totals.capacity.quad_groups + totals.capacity.line_groups + slot / kPointGroup];
  Item item = items[group.x];
  uint rank = group.y + slot % kPointGroup;
  out_colour = vec3(0.0);
  out_samples = 0u;
  out_share = uvec2(0u);
  gl_Position = kNowhere;
  gl_PointSize = 1.0;
  if (rank >= item.count) return;
  LeafPoint point = points[item.first + rank];
  TreeRecord tree = trees[item.record];
  out_share = share_of(tree);
  vec3 rel = swayed(tree, point.position_area.xyz, point.rest.x);
  gl_Position = clip_position(rel);
  float area = point.position_area.w * item.scale * scaled_area(tree, rel);
  float pixels = area * facing_pixels(rel, depth_of(rel, gl_Position));
  pixels *= clamp((item.edge - float(rank)) / item.fade, 0.0, 1.0);
  // Less than a pixel is drawn as a part of one: the same samples of all pixels that it touches, so that it covers as
  // many as it should wherever it lies.
  uint hash = mixed(tree.hash + rank);
  out_samples = samples_of(min(pixels, 1.0), noise_of(hash), hash);
  vec3 light, air;
  plant_light(rel, turn_normal(tree, point.rest.x), uintBitsToFloat(point.rest.z), 1.0, tint_of(tree), light, air);
  vec3 srgb = vec3(point.rest.y & 255u, (point.rest.y >> 8u) & 255u, (point.rest.y >> 16u) & 255u) * (1.0 / 255.0);
  // Film is not linear: what the point is the mean of is on it as two halves, one lighter and one darker.
  vec3 mean = plant_albedo(srgb) * light, off = mean * (float(point.rest.y >> 24u) * (1.0 / 255.0));
  out_colour = 0.5 * (plant_film(mean + off + air) + plant_film(mean - off + air));
  gl_PointSize = sqrt(max(pixels, 1.0));
}

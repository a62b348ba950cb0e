// What the three ways of drawing a plant's primitives have in common. The host of the plants supplies, before this:
//   vec4 clip_position(vec3 rel);                     rel: metres relative to the eye; w: metres along the view
//   void plant_light(vec3 rel, vec3 normal, float shade, float leaf, float tint, out vec3 light, out vec3 air);
//                                                     what arrives at the eye is albedo * light + air, linear
//   vec3 plant_film(vec3 arriving);                   what the picture shows of that
layout(std430, binding = 9) readonly buffer Trees { TreeRecord trees[]; };
layout(std430, binding = 15) readonly buffer Items { Item items[]; };
layout(std430, binding = 16) readonly buffer Groups { uvec2 groups[]; };
layout(std430, binding = 8) readonly buffer TotalsBuffer { Totals totals; };

layout(std430, binding = 3) readonly buffer PlantHeads { PlantHead heads[]; };

const vec4 kNowhere = vec4(2.0, 2.0, 2.0, 1.0);  // outside of every picture, for what is not drawn

vec3 place(TreeRecord tree, vec3 p) {
  vec4 q = vec4(p, 1.0);
  return vec3(dot(tree.row_x, q), dot(tree.row_y, q), dot(tree.row_z, q));
}

vec3 swayed(TreeRecord tree, vec3 p, uint packed_normal) {
  vec3 rel = place(tree, p);
  if (wind.xyz == vec3(0.0)) return rel;
  float height = 2.0 * heads[tree.plant].middle, metres = length(vec3(tree.row_x.z, tree.row_y.z, tree.row_z.z)) * height;
  return rel + sway(p, height, metres, tree.hash, float(packed_normal >> 30u) / 3.0);
}

// Squares of the scales across and along the axis.
vec2 scales2(TreeRecord tree) {
  vec3 x = vec3(tree.row_x.x, tree.row_y.x, tree.row_z.x), z = vec3(tree.row_x.z, tree.row_y.z, tree.row_z.z);
  return vec2(dot(x, x), dot(z, z));
}

vec3 turn_normal(TreeRecord tree, uint bits) {
  vec2 s = scales2(tree);
  vec3 n = unpack_normal(bits) / s.xxy;
  return normalize(vec3(dot(tree.row_x.xyz, n), dot(tree.row_y.xyz, n), dot(tree.row_z.xyz, n)));
}

// Its hash; how much of it mosaics show, 255ths.
uvec2 share_of(TreeRecord tree) { return uvec2(tree.hash, tree.site >> kShareShift); }

float tint_of(TreeRecord tree) { return float(tree.hash & 255u) * (1.0 / 255.0); }

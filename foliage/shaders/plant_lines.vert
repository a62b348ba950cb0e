// A ribbon that turns to the eye, at least a pixel wide; what it is too wide, alpha takes back. A piece of a branch, or
// a thin leaf.
struct LineSegment {
  vec4 a;  // w: radius
  vec4 b;
  uvec4 rest;  // shade, as floatBitsToUint; level, a leaf's normal; branch; a leaf's sRGB colour
};
const uint kOfLeaf = 0xffffffffu;  // in place of a branch
layout(std430, binding = 17) readonly buffer Lines { LineSegment lines[]; };
layout(binding = 0) uniform sampler2DArray plants_images;

layout(location = 0) out vec4 out_light;  // alpha
layout(location = 1) out vec3 out_air;
layout(location = 2) flat out uint out_hash;
layout(location = 7) flat out uvec2 out_share;

// Of a flat leaf, over its own width: what its area and its length look like from there.
float seen_width(vec3 normal, vec3 along, vec3 sight) {
  return abs(dot(normal, sight)) / max(length(cross(along, sight)), 0.02);
}

void main() {
  uint slot = uint(gl_VertexID) >> 2u, corner = uint(gl_VertexID) & 3u;
  uvec2 group = groups[totals.capacity.quad_groups + slot / kLineGroup];
  Item item = items[group.x];
  uint rank = group.y + slot % kLineGroup;
  out_light = vec4(0.0);
  out_air = vec3(0.0);
  out_hash = 0u;
  out_share = uvec2(0u);
  gl_Position = kNowhere;
  if (rank >= item.count) return;
  uint index = rank + (rank < uint(item.edge) ? item.first : item.second);
  LineSegment line = lines[index];
  TreeRecord tree = trees[item.record];
  out_share = share_of(tree);
  vec4 end = corner == 1u || corner == 2u ? line.b : line.a;
  bool leaf = line.rest.z == kOfLeaf;
  uint level = leaf ? line.rest.y : min(line.rest.y, 3u) << 30u;
  vec3 a = swayed(tree, line.a.xyz, level), b = swayed(tree, line.b.xyz, level), rel = swayed(tree, end.xyz, level);
  vec3 side = cross(b - a, rel);
  side /= max(length(side), 1e-20);
  vec3 leaf_normal = leaf ? turn_normal(tree, line.rest.y) : vec3(0.0);
  float width = end.w * sqrt(scales2(tree).x);
  if (leaf) width *= seen_width(leaf_normal, normalize(b - a), normalize(rel));
  float least = 0.5 * depth_of(rel, clip_position(rel)) / focal_px;
  float drawn = max(width, least), across = corner < 2u ? -1.0 : 1.0;
  vec3 towards = normalize(cross(side, b - a));
  if (dot(towards, rel) > 0.0) towards = -towards;
  vec3 normal = leaf ? leaf_normal : normalize(towards + across * side), light;
  plant_light(rel, normal, uintBitsToFloat(line.rest.x), float(leaf), tint_of(tree), light, out_air);
  vec3 srgb = leaf ? vec3((line.rest.www >> uvec3(0u, 8u, 16u)) & 255u) * (1.0 / 255.0)
                   : textureLod(plants_images, vec3(0.5, 0.5, float(2u * tree.plant)), 8.0).rgb;
  out_light = vec4(light * plant_albedo(srgb), width / drawn);
  out_hash = mixed(tree.hash + index);
  gl_Position = clip_position(rel + side * (across * drawn));
}

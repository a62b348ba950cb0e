layout(location = 0) centroid out vec3 out_uv;
layout(location = 1) centroid out vec3 out_light;
layout(location = 2) centroid out vec3 out_air;
layout(location = 3) flat out uint out_hash;
layout(location = 7) flat out uvec2 out_share;

void main() {
  uint slot = uint(gl_VertexID) >> 2u, corner = uint(gl_VertexID) & 3u;
  uvec2 group = groups[slot / kQuadGroup];
  Item item = items[group.x];
  uint rank = group.y + slot % kQuadGroup;
  out_uv = out_light = out_air = vec3(0.0);
  out_hash = 0u;
  out_share = uvec2(0u);
  gl_Position = kNowhere;
  if (rank >= item.count) return;
  uint index = item.first + rank;
  uvec4 bits = quads[index].corners[corner], anchor_shades = quads[index].anchor_shades;
  TreeRecord tree = trees[item.record];
  out_share = share_of(tree);
  vec3 p = uintBitsToFloat(bits.xyz);
  float leaf = float(item.kind);
  if (item.kind == kLeaves) {
    vec3 anchor = uintBitsToFloat(anchor_shades.xyz);
    float left = clamp((item.edge - float(rank)) / item.fade, 0.0, 1.0);
    p = anchor + (p - anchor) * (item.scale * sqrt(left));
  }
  vec3 rel = swayed(tree, p, quads[index].normals[corner]);
  float shade = float((anchor_shades.w >> (8u * corner)) & 255u) * (1.0 / 255.0);
  out_uv = vec3(corner_uv(bits), float(2u * tree.plant) + leaf);
  plant_light(rel, turn_normal(tree, quads[index].normals[corner]), shade, leaf, tint_of(tree), out_light, out_air);
  out_hash = mixed(tree.hash + index);
  gl_Position = clip_position(rel);
}

// Mosaics of trees: rectangles that stay as they were seen from their side.
struct LdmBlock {
  uint page, picture;  // x, y, page, shrink; column, row, pixel; a byte each
};
struct LdmMosaic {
  uint block_depth, box;
};
layout(std430, binding = 4) readonly buffer LdmTrees { LdmTree ldm_trees[]; };
layout(std430, binding = 5) readonly buffer LdmItems { LdmItem ldm_items[]; };
layout(std430, binding = 6) readonly buffer LdmGroups { uvec2 ldm_groups[]; };
layout(std430, binding = 7) readonly buffer LdmSides { LdmSideHead ldm_sides[]; };
layout(std430, binding = 10) readonly buffer LdmBlocks { LdmBlock ldm_blocks[]; };
layout(std430, binding = 11) readonly buffer LdmMosaics { LdmMosaic ldm_mosaics[]; };

layout(location = 0) out vec3 out_rel;
layout(location = 1) centroid out vec2 out_texel;  // of the page; beside the mosaic there is nothing to see
layout(location = 2) flat out uvec4 out_square;  // of the page: x, y, log2 of its side (8 bits) and ldm_most_level(), page
layout(location = 3) flat out vec3 out_normal_x;
layout(location = 4) flat out vec3 out_normal_y;
layout(location = 5) flat out vec3 out_normal_z;
layout(location = 6) flat out vec3 out_share;  // low, high; tint
layout(location = 7) flat out uvec2 out_hash;  // of the tree, of the mosaic

void main() {
  uint slot = uint(gl_VertexID) >> 2u, corner = uint(gl_VertexID) & 3u;
  uvec2 group = ldm_groups[slot / kLdmGroup];
  LdmItem item = ldm_items[group.x];
  uint index = group.y + slot % kLdmGroup;
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // outside of every picture
  if (index >= item.last) return;
  LdmMosaic mosaic = ldm_mosaics[index];
  LdmSideHead side = ldm_sides[item.side];
  LdmBlock block = ldm_blocks[side.first_block + (mosaic.block_depth & 0xffffu)];
  const uvec4 bytes = uvec4(0u, 8u, 16u, 24u);
  uvec4 page = uvec4(block.page) >> bytes & 255u, picture = uvec4(block.picture) >> bytes & 255u, box = uvec4(mosaic.box) >> bytes & 255u;
  vec2 at = vec2(corner == 1u || corner == 2u ? box.z : box.x, corner >= 2u ? box.w : box.y);
  LdmTree tree = ldm_trees[item.tree];
  float pixel = float(picture.z);
  vec2 middle = pixel * (32.0 * vec2(picture.xy) + 0.5 * vec2(box.xy + box.zw)), off = pixel * (at - 0.5 * vec2(box.xy + box.zw));
  vec3 p = (side.origin + middle.x * side.right + middle.y * side.up +
            float(mosaic.block_depth >> 16u) * side.inward).xyz;
  vec3 towards = normalize(-side.inward.xyz);
  p += turned(off.x * side.right.xyz + off.y * side.up.xyz, towards, tree.to_eye, item.grown);
  out_rel = vec3(dot(tree.row_x, vec4(p, 1.0)), dot(tree.row_y, vec4(p, 1.0)), dot(tree.row_z, vec4(p, 1.0)));
  if (side.height > 0.0 && wind.xyz != vec3(0.0)) {
    float metres = length(vec3(tree.row_x.z, tree.row_y.z, tree.row_z.z)) * side.height;
    out_rel += sway(p, side.height, metres, tree.hash, 0.0);  // boughs would swing by less than a fifth of what may be wrong
  }
  out_texel = vec2(page.xy) + at * exp2(-float(page.w));
  uint most = ldm_most_level(box.z - box.x, box.w - box.y, page.w);
  out_square = uvec4(page.xy, (5u - page.w) | most << 8u, side.first_page + page.z);
  vec3 x = vec3(tree.row_x.x, tree.row_y.x, tree.row_z.x), z = vec3(tree.row_x.z, tree.row_y.z, tree.row_z.z);
  vec3 inverse = 1.0 / vec3(vec2(dot(x, x)), dot(z, z));
  out_normal_x = tree.row_x.xyz * inverse;
  out_normal_y = tree.row_y.xyz * inverse;
  out_normal_z = tree.row_z.xyz * inverse;
  out_share = vec3(item.low, item.high, float(tree.hash & 255u) * (1.0 / 255.0));
  out_hash = uvec2(tree.hash, mixed(side.number * 64u + (mosaic.block_depth >> 16u) / 1024u + tree.hash));
  gl_Position = clip_position(out_rel);
}

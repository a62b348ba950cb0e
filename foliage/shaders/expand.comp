layout(local_size_x = 64) in;
layout(std430, binding = 10) restrict readonly buffer Sums { uint offsets[]; };
layout(std430, binding = 11) restrict readonly buffer Blocks { uint blocks[]; };
layout(std430, binding = 13) restrict readonly buffer TreeSums { uvec4 tree_offsets[]; };
layout(std430, binding = 14) restrict readonly buffer TreeBlocks { uvec4 tree_blocks[]; };
layout(std430, binding = 15) restrict readonly buffer Items { Item items[]; };
layout(std430, binding = 16) restrict writeonly buffer Groups { uvec2 groups[]; };  // item, first rank
layout(std430, binding = 19) restrict readonly buffer Counts { uvec4 counts[]; };

// One loop for a tree's four items: software devices run it as often as the longest of several trees needs.
void expand_tree(uint i, uvec4 begin, uvec4 end) {
  const uvec4 size = uvec4(kQuadGroup, kLineGroup, kPointGroup, kPointGroup);
  uvec4 at = plus(plus(tree_offsets[i], tree_blocks[i / kScanBlock]), totals.groups_before).xyzz;
  uvec4 first = begin + min(at, end - begin), n = (counts[i] + size - 1u) / size;
  n.xyz = min(n.xyz, end.xyz - first.xyz);
  first.w += n.z;
  n.w = min(n.w, end.w - first.w);
  uint item = (totals.first_tree + i) * kFixedItems;
  uvec4 until = uvec4(n.x, n.x + n.y, n.x + n.y + n.z, n.x + n.y + n.z + n.w), from = until - n;
  for (uint k = 0u; k < until.w; ++k) {
    uint kind = uint(k >= until.x) + uint(k >= until.y) + uint(k >= until.z), of_item = k - from[kind];
    groups[first[kind] + of_item] = uvec2(item + kind, of_item * size[kind]);
  }
}

void expand_cell(uint i, uint end) {
  uint item = first_cell_item() + i;
  uint first = min(plus(plus(offsets[i], blocks[i / kScanBlock]), totals.groups_before.w), end);
  uint n = min(groups_of(items[item].count, kQuadGroup), end - first);
  for (uint k = 0u; k < n; ++k) groups[first + k] = uvec2(item, k * kQuadGroup);
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  Capacity room = totals.capacity;
  uint lines = room.quad_groups, points = lines + room.line_groups, end = points + room.point_groups;
  if (i < totals.trees) expand_tree(i, uvec4(0u, lines, points, points), uvec4(lines, points, end, end));
  if (i < totals.cells) expand_cell(i, lines);
}

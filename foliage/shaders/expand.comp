layout(local_size_x = 64) in;
layout(std430, binding = 10) restrict readonly buffer Sums { uvec4 offsets[]; };
layout(std430, binding = 11) restrict readonly buffer Blocks { uvec4 blocks[]; };
layout(std430, binding = 13) restrict readonly buffer TreeSums { uvec4 tree_offsets[]; };
layout(std430, binding = 14) restrict readonly buffer TreeBlocks { uvec4 tree_blocks[]; };
layout(std430, binding = 15) restrict readonly buffer Items { Item items[]; };
layout(std430, binding = 16) restrict writeonly buffer Groups { uvec2 groups[]; };  // item, first rank

// Lists: quads', lines', points'. Returns where the item's groups end.
uint write(uint item, uint at, uint begin, uint end, uint size) {
  at = min(at, end - begin) + begin;
  uint n = min(groups_of(items[item].count, size), end - at);
  for (uint i = 0u; i < n; ++i) groups[at + i] = uvec2(item, i * size);
  return at + n - begin;
}

void expand_tree(uint i, uvec3 ends) {
  uint item = (totals.first_tree + i) * kFixedItems;
  uvec4 at = plus(plus(tree_offsets[i], tree_blocks[i / kScanBlock]), totals.groups_before);
  write(item, at.x, 0u, ends.x, kQuadGroup);
  write(item + 1u, at.y, ends.x, ends.y, kLineGroup);
  uint coarse = write(item + 2u, at.z, ends.y, ends.z, kPointGroup);
  write(item + 3u, coarse, ends.y, ends.z, kPointGroup);
}

void expand_cell(uint i, uvec3 ends) {
  uvec4 at = plus(plus(offsets[i], blocks[i / kScanBlock]), totals.groups_before.wwww);
  write(first_cell_item() + i, at.x, 0u, ends.x, kQuadGroup);
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  Capacity room = totals.capacity;
  uint lines = room.quad_groups, points = lines + room.line_groups;
  uvec3 ends = uvec3(lines, points, points + room.point_groups);
  if (i < totals.trees) expand_tree(i, ends);
  if (i < totals.cells) expand_cell(i, ends);
}

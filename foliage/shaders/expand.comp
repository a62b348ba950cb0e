layout(local_size_x = 64) in;
layout(std430, binding = 10) readonly buffer Sums { uvec4 offsets[]; };
layout(std430, binding = 11) readonly buffer Blocks { uvec4 blocks[]; };
layout(std430, binding = 15) readonly buffer Items { Item items[]; };
layout(std430, binding = 16) writeonly buffer Groups { uvec2 groups[]; };  // item, first rank; quads', lines', points'

void write(Item item, uint index, uint at, uint end, uint size) {
  for (uint rank = 0u; rank < item.count && at < end; rank += size) groups[at++] = uvec2(index, rank);
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= totals.items) return;
  uint index = totals.items_before + i;
  Item item = items[index];
  uvec4 at = plus(plus(offsets[i], blocks[i / kScanBlock]), totals.groups_before);
  Capacity room = totals.capacity;
  uint lines = room.quad_groups, points = lines + room.line_groups;
  at.xyz = min(at.xyz, uvec3(room.quad_groups, room.line_groups, room.point_groups));
  if (item.kind <= kLeaves) write(item, index, at.x, lines, kQuadGroup);
  else if (item.kind == kLines) write(item, index, lines + at.y, points, kLineGroup);
  else write(item, index, points + at.z, points + room.point_groups, kPointGroup);
}

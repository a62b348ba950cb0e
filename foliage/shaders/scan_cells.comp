// Sums of the groups of quads that cells' items take; then the draws' commands.
layout(std430, binding = 12) restrict writeonly buffer Commands { uint commands[]; };
layout(std430, binding = 15) restrict readonly buffer Items { Item items[]; };

uint size_of(uint i, inout uvec4 primitives) {
  uint count = items[first_cell_item() + i].count;
  primitives.y += count;
  return groups_of(count, kQuadGroup);
}

void write_quads(uint first_word, uint draws, uint quads) {
  for (uint i = gl_LocalInvocationID.x; i < draws; i += kSumThreads) {
    uint from = i * kQuadsOfDraw, word = first_word + 5u * i;
    commands[word] = 6u * (quads > from ? min(quads - from, kQuadsOfDraw) : 0u);
    commands[word + 1u] = 1u;
    commands[word + 2u] = 0u;
    commands[word + 3u] = 4u * from;
    commands[word + 4u] = 0u;
  }
}

void finish(uint total) {
  Capacity room = totals.capacity;
  uvec4 most = uvec4(room.quad_groups, room.line_groups, room.point_groups, 0u);
  uvec4 wanted = plus(totals.groups, uvec4(total, 0u, 0u, 0u)), groups = min(wanted, most);
  barrier();
  if (gl_LocalInvocationID.x == 0u) {
    totals.groups = wanted;
    totals.missing.yzw = (wanted - groups).xyz;
    uint word = 5u * (room.quad_draws + room.line_draws);
    commands[word] = groups.z * kPointGroup;
    commands[word + 1u] = 1u;
    commands[word + 2u] = 0u;
    commands[word + 3u] = 0u;
  }
  write_quads(0u, room.quad_draws, groups.x * kQuadGroup);
  write_quads(5u * room.quad_draws, room.line_draws, groups.y * kLineGroup);
}

void main() { sum_all(totals.cells); }

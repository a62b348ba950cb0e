// Exclusive sums of the blocks' totals, by one work group; then the sizes of what comes next.
layout(local_size_x = 256) in;
layout(std430, binding = 11) restrict buffer Blocks { uvec4 blocks[]; };
layout(std430, binding = 12) restrict writeonly buffer Commands { uint commands[]; };
layout(location = 0) uniform uint of_cells;

shared uvec4 part[256];

void write_quads(uint first_word, uint draws, uint quads) {
  for (uint i = gl_LocalInvocationID.x; i < draws; i += 256u) {
    uint from = i * kQuadsOfDraw, word = first_word + 5u * i;
    commands[word] = 6u * (quads > from ? min(quads - from, kQuadsOfDraw) : 0u);
    commands[word + 1u] = 1u;
    commands[word + 2u] = 0u;
    commands[word + 3u] = 4u * from;
    commands[word + 4u] = 0u;
  }
}

// Bark goes before the node's leaves.
void finish_trees(uvec4 total) {
  if (gl_LocalInvocationID.x != 0u) return;
  totals.cells_before += totals.cells;
  uint room = totals.capacity.cells - totals.cells_before, cells = min(total.w, room);
  totals.missing.x += total.w - cells;
  totals.cells = cells;
  uvec4 bark = plus(totals.groups, uvec4(total.x, 0u, 0u, 0u));
  totals.groups_before = uvec4(totals.groups.xyz, bark.x);
  totals.groups = plus(bark, uvec4(0u, total.yz, 0u));
  totals.per_cell = uvec4((cells + 63u) / 64u, 1u, 1u, 0u);
  totals.per_block = uvec4((cells + kScanBlock - 1u) / kScanBlock, 1u, 1u, 0u);
  totals.per_row = uvec4((max(cells, totals.trees) + 63u) / 64u, 1u, 1u, 0u);
}

void finish_cells(uvec4 total) {
  Capacity room = totals.capacity;
  uvec4 most = uvec4(room.quad_groups, room.line_groups, room.point_groups, 0u);
  uvec4 wanted = plus(totals.groups, uvec4(total.x, 0u, 0u, 0u)), groups = min(wanted, most);
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

void main() {
  uint t = gl_LocalInvocationID.x, count = of_cells != 0u ? totals.cells : totals.trees;
  count = (count + kScanBlock - 1u) / kScanBlock;
  uvec4 total = uvec4(0u);
  for (uint first = 0u; first < count; first += 256u) {
    uvec4 mine = first + t < count ? blocks[first + t] : uvec4(0u);
    part[t] = mine;
    for (uint step = 1u; step < min(count - first, 256u); step *= 2u) {
      barrier();
      uvec4 left = t >= step ? part[t - step] : uvec4(0u);
      barrier();
      part[t] = plus(part[t], left);
    }
    barrier();
    if (first + t < count) blocks[first + t] = plus(total, t > 0u ? part[t - 1u] : uvec4(0u));
    total = plus(total, part[min(count - first, 256u) - 1u]);
    barrier();
  }
  if (of_cells == 0u) finish_trees(total);
  else finish_cells(total);
}

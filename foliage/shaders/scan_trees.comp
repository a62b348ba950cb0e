// Sums of the groups that trees' fixed items take of the lists, and of how many cells each tree shows.
layout(std430, binding = 19) restrict readonly buffer Counts { uvec4 counts[]; };

// Groups of quads, lines, points; cells.
uvec4 size_of(uint i, inout uvec4 primitives) {
  uvec4 count = counts[i];
  primitives += uvec4(count.x, 0u, count.y, count.z + count.w);
  return uvec4(groups_of(count.x, kQuadGroup), groups_of(count.y, kLineGroup),
               groups_of(count.z, kPointGroup) + groups_of(count.w, kPointGroup), offsets[i].w);
}

// Bark goes before the node's leaves.
void finish(uvec4 total) {
  if (gl_LocalInvocationID.x != 0u) return;
  totals.cells_before += totals.cells;
  uint room = totals.capacity.cells - totals.cells_before, cells = min(total.w, room);
  totals.missing.x += total.w - cells;
  totals.cells = cells;
  uvec4 bark = plus(totals.groups, uvec4(total.x, 0u, 0u, 0u));
  totals.groups_before = uvec4(totals.groups.xyz, bark.x);
  totals.groups = plus(bark, uvec4(0u, total.yz, 0u));
  totals.per_cell = uvec4((cells + 63u) / 64u, 1u, 1u, 0u);
  totals.per_block = uvec4(max((cells + kScanBlock - 1u) / kScanBlock, 1u), 1u, 1u, 0u);  // one finishes in any case
  totals.per_row = uvec4((max(cells, totals.trees) + 63u) / 64u, 1u, 1u, 0u);
}

void main() { sum_all(totals.trees); }

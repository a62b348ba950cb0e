// Exclusive sums within blocks of kScanBlock, and each block's total, of what items take of the lists: trees' fixed ones,
// with how many cells each tree shows, or cells' own.  [Blelloch 1990, "Prefix sums and their applications"]
layout(local_size_x = 128) in;
layout(std430, binding = 10) restrict buffer Sums { uvec4 offsets[]; };
layout(std430, binding = 11) restrict writeonly buffer Blocks { uvec4 blocks[]; };
layout(std430, binding = 15) restrict readonly buffer Items { Item items[]; };
layout(location = 0) uniform uint of_cells;

const uint kThreads = 128u, kEach = kScanBlock / kThreads;
shared uvec4 part[kThreads];
shared uint shown[4];

// Groups, and cells in w; adds to the primitives of each kind.
uvec4 size_of(uint i, inout uvec4 primitives) {
  if (of_cells != 0u) {
    uint leaves = items[first_cell_item() + i].count;
    primitives.y += leaves;
    return uvec4(groups_of(leaves, kQuadGroup), 0u, 0u, 0u);
  }
  uint item = (totals.first_tree + i) * kFixedItems;
  uvec4 count = uvec4(items[item].count, items[item + 1u].count, items[item + 2u].count, items[item + 3u].count);
  primitives += uvec4(count.x, 0u, count.y, count.z + count.w);
  return uvec4(groups_of(count.x, kQuadGroup), groups_of(count.y, kLineGroup),
               groups_of(count.z, kPointGroup) + groups_of(count.w, kPointGroup), offsets[i].w);
}

void main() {
  uint count = of_cells != 0u ? totals.cells : totals.trees;
  uint t = gl_LocalInvocationID.x, first = gl_WorkGroupID.x * kScanBlock + kEach * t;
  uvec4 mine[kEach];
  uvec4 sum = uvec4(0u), primitives = uvec4(0u);
  for (uint i = 0u; i < kEach; ++i) {
    mine[i] = sum;
    if (first + i < count) sum = plus(sum, size_of(first + i, primitives));
  }
  part[t] = sum;
  if (t < 4u) shown[t] = 0u;
  for (uint step = 1u; step < kThreads; step *= 2u) {
    barrier();
    uvec4 left = t >= step ? part[t - step] : uvec4(0u);
    barrier();
    part[t] = plus(part[t], left);
  }
  for (uint kind = 0u; kind < 4u; ++kind)
    if (primitives[kind] > 0u) atomicAdd(shown[kind], primitives[kind]);
  barrier();
  uvec4 before = t > 0u ? part[t - 1u] : uvec4(0u);
  for (uint i = 0u; i < kEach; ++i)
    if (first + i < count) offsets[first + i] = plus(before, mine[i]);
  if (t == kThreads - 1u) blocks[gl_WorkGroupID.x] = part[t];
  if (t < 4u && shown[t] > 0u) atomicAdd(totals.shown[t], shown[t]);
}

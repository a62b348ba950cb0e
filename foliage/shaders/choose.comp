layout(local_size_x = 64) in;
layout(std430, binding = 9) readonly buffer Trees { TreeRecord trees[]; };
layout(std430, binding = 10) writeonly buffer Sums { uvec4 offsets[]; };
layout(std430, binding = 13) readonly buffer TreeSums { uvec4 tree_offsets[]; };
layout(std430, binding = 14) readonly buffer TreeBlocks { uvec4 tree_blocks[]; };
layout(std430, binding = 15) writeonly buffer Items { Item items[]; };

uint first_item(uint tree) { return tree_offsets[tree].x + tree_blocks[tree / kScanBlock].x; }

uint tree_of(uint item) {
  uint low = 0u, high = totals.trees;
  while (high - low > 1u) {
    uint middle = (low + high) / 2u;
    if (first_item(middle) <= item) low = middle;
    else high = middle;
  }
  return low;
}

uint groups_of(uint count, uint size) { return (count + size - 1u) / size; }

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= totals.items) return;
  uint local = tree_of(i), record = totals.first_tree + local;
  Item item = choose_item(trees[record], record, i - first_item(local));
  items[totals.items_before + i] = item;
  if (item.count > 0u) atomicAdd(totals.shown[item.kind], item.count);
  bool quads = item.kind <= kLeaves;
  offsets[i] = uvec4(quads ? groups_of(item.count, kQuadGroup) : 0u,
                     item.kind == kLines ? groups_of(item.count, kLineGroup) : 0u,
                     item.kind == kPoints ? groups_of(item.count, kPointGroup) : 0u, 0u);
}

layout(local_size_x = 64) in;
layout(std430, binding = 9) restrict readonly buffer Trees { TreeRecord trees[]; };
layout(std430, binding = 13) restrict readonly buffer TreeSums { uvec4 tree_offsets[]; };
layout(std430, binding = 14) restrict readonly buffer TreeBlocks { uvec4 tree_blocks[]; };
layout(std430, binding = 15) restrict writeonly buffer Items { Item items[]; };

// The last block of trees, and of these the last, whose cells begin at this one or before. All invocations take the same
// steps.
uint tree_of(uint cell, out uint first) {
  uint block = 0u, last_block = (totals.trees - 1u) / kScanBlock;
  for (uint step = 1u << findMSB(last_block | 1u); step > 0u; step /= 2u) {
    uint next = min(block + step, last_block);
    if (tree_blocks[next].w <= cell) block = next;
  }
  uint before = tree_blocks[block].w, tree = block * kScanBlock, last = min(tree + kScanBlock, totals.trees) - 1u;
  for (uint step = kScanBlock / 2u; step > 0u; step /= 2u) {
    uint next = min(tree + step, last);
    if (before + tree_offsets[next].w <= cell) tree = next;
  }
  first = before + tree_offsets[tree].w;
  return tree;
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= totals.cells) return;
  uint first, local = tree_of(i, first), record = totals.first_tree + local;
  items[first_cell_item() + i] = cell_item(trees[record], record, i - first);
}

layout(local_size_x = 64) in;
layout(std430, binding = 9) restrict readonly buffer Trees { TreeRecord trees[]; };
layout(std430, binding = 13) restrict readonly buffer TreeSums { uvec4 tree_offsets[]; };
layout(std430, binding = 14) restrict readonly buffer TreeBlocks { uvec4 tree_blocks[]; };
layout(std430, binding = 15) restrict writeonly buffer Items { Item items[]; };

// The last block of trees, and of these the last, whose cells begin at this one or before.
uint tree_of(uint cell, out uint first) {
  uint low = 0u, high = (totals.trees + kScanBlock - 1u) / kScanBlock;
  while (high - low > 1u) {
    uint middle = (low + high) / 2u;
    if (tree_blocks[middle].w <= cell) low = middle;
    else high = middle;
  }
  uint before = tree_blocks[low].w;
  low *= kScanBlock;
  high = min(low + kScanBlock, totals.trees);
  while (high - low > 1u) {
    uint middle = (low + high) / 2u;
    if (before + tree_offsets[middle].w <= cell) low = middle;
    else high = middle;
  }
  first = before + tree_offsets[low].w;
  return low;
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= totals.cells) return;
  uint first, local = tree_of(i, first), record = totals.first_tree + local;
  items[first_cell_item() + i] = cell_item(trees[record], record, i - first);
}

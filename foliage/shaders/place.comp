layout(local_size_x = 64) in;
layout(std430, binding = 7) readonly buffer Runs { uvec2 runs[]; };  // first site, first tree in view; sorted
layout(std430, binding = 9) writeonly buffer Trees { TreeRecord trees[]; };
layout(std430, binding = 10) writeonly buffer Sums { uvec4 offsets[]; };

uint run_of(uint tree) {
  uint low = 0u, high = totals.runs;
  while (high - low > 1u) {
    uint middle = (low + high) / 2u;
    if (runs[middle].y <= tree) low = middle;
    else high = middle;
  }
  return low;
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= totals.trees) return;
  uint index = totals.first_tree + i;
  uvec2 run = runs[run_of(index)];
  TreeRecord tree = place_tree(run.x + (index - run.y));
  trees[index] = tree;
  offsets[i] = uvec4(items_of(tree), 0u, 0u, 0u);
}

// The arrays of select.glsl, as the GPU holds them.
layout(std430, binding = 1) restrict readonly buffer BlockRows { vec4 block_rows[]; };
layout(std430, binding = 2) restrict readonly buffer Sites { TreeSite sites[]; };
layout(std430, binding = 3) restrict readonly buffer Plants { PlantHead plants[]; };
layout(std430, binding = 4) restrict readonly buffer Cells { CellHead cells[]; };
layout(std430, binding = 5) restrict readonly buffer Details { Detail details[]; };
layout(std430, binding = 6) restrict readonly buffer Views { uint views[]; };
layout(std430, binding = 8) restrict buffer TotalsBuffer { Totals totals; };
layout(std430, binding = 18) restrict readonly buffer Steps { uvec2 steps[]; };
// Sums end at the largest number there is: more than any list has room for.
uvec4 plus(uvec4 a, uvec4 b) {
  uvec4 sum = a + b;
  return mix(sum, uvec4(0xffffffffu), lessThan(sum, a));
}

uint plus(uint a, uint b) {
  uint sum = a + b;
  return sum < a ? 0xffffffffu : sum;
}

uint groups_of(uint count, uint size) { return (count + size - 1u) / size; }

// Of the node's cells.
uint first_cell_item() { return totals.all_trees * kFixedItems + totals.cells_before; }

#define error2_at_1m totals.error2_at_1m
#define heed_neighbours totals.heed_neighbours
#define view_sides totals.view_sides

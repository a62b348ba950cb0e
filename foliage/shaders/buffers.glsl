// The arrays of select.glsl, as the GPU holds them.
layout(std430, binding = 1) readonly buffer BlockRows { vec4 block_rows[]; };
layout(std430, binding = 2) readonly buffer Sites { TreeSite sites[]; };
layout(std430, binding = 3) readonly buffer Plants { PlantHead plants[]; };
layout(std430, binding = 4) readonly buffer Cells { CellHead cells[]; };
layout(std430, binding = 5) readonly buffer Details { Detail details[]; };
layout(std430, binding = 6) readonly buffer Views { uint views[]; };
layout(std430, binding = 8) buffer TotalsBuffer { Totals totals; };
layout(std430, binding = 18) readonly buffer Steps { uvec2 steps[]; };
// Sums end at the largest number there is: more than any list has room for.
uvec4 plus(uvec4 a, uvec4 b) {
  uvec4 sum = a + b;
  return mix(sum, uvec4(0xffffffffu), lessThan(sum, a));
}

#define error2_at_1m totals.error2_at_1m

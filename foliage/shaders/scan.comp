// Exclusive sums within blocks of kScanBlock, and each block's total.  [Blelloch 1990, "Prefix sums and their
// applications"]
layout(local_size_x = 256) in;
layout(std430, binding = 10) buffer Sums { uvec4 offsets[]; };
layout(std430, binding = 11) buffer Blocks { uvec4 blocks[]; };
layout(location = 0) uniform uint of_items;

shared uvec4 part[256];

void main() {
  uint count = of_items != 0u ? totals.items : totals.trees;
  uint t = gl_LocalInvocationID.x, first = gl_WorkGroupID.x * kScanBlock + 4u * t;
  uvec4 mine[4];
  uvec4 sum = uvec4(0u);
  for (uint i = 0u; i < 4u; ++i) {
    mine[i] = sum;
    if (first + i < count) sum = plus(sum, offsets[first + i]);
  }
  part[t] = sum;
  for (uint step = 1u; step < 256u; step *= 2u) {
    barrier();
    uvec4 left = t >= step ? part[t - step] : uvec4(0u);
    barrier();
    part[t] = plus(part[t], left);
  }
  barrier();
  uvec4 before = t > 0u ? part[t - 1u] : uvec4(0u);
  for (uint i = 0u; i < 4u; ++i)
    if (first + i < count) offsets[first + i] = plus(before, mine[i]);
  if (t == 255u) blocks[gl_WorkGroupID.x] = part[t];
}

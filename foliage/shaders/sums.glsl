// Exclusive sums over the elements of a list, in one dispatch: within blocks, a work group each; and of the blocks, by
// the work group that is the last to have done its own, so that none waits for another.  [Blelloch 1990, "Prefix sums
// and their applications"]
//   Sum: uint or uvec4
layout(local_size_x = kSumThreads) in;
layout(std430, binding = 10) restrict buffer Sums { Sum offsets[]; };
layout(std430, binding = 11) restrict coherent buffer Blocks { Sum blocks[]; };

Sum size_of(uint i, inout uvec4 primitives);  // of an element; adds to the primitives of each kind
void finish(Sum total);                       // called by all of the last work group

const uint kEach = kScanBlock / kSumThreads, kRow = 8u, kRows = kSumThreads / kRow;
shared Sum part[kSumThreads], rows[kRows], whole;
shared uint shown[4];
shared bool last;

// Of what the invocations of the work group bring. Rows of them one after the other: few barriers, which cost software
// devices most.
Sum sum_before(Sum mine) {
  uint t = gl_LocalInvocationID.x;
  part[t] = mine;
  barrier();
  Sum sum = Sum(0u);
  for (uint i = t * kRow; t < kRows && i < (t + 1u) * kRow; ++i) {
    Sum next = plus(sum, part[i]);
    part[i] = sum;
    sum = next;
  }
  if (t < kRows) rows[t] = sum;
  barrier();
  sum = Sum(0u);
  for (uint i = 0u; t == 0u && i < kRows; ++i) {
    Sum next = plus(sum, rows[i]);
    rows[i] = sum;
    sum = next;
  }
  if (t == 0u) whole = sum;
  barrier();
  return plus(part[t], rows[t / kRow]);
}

void sum_blocks() {
  uint n = gl_NumWorkGroups.x, each = (n + kSumThreads - 1u) / kSumThreads;
  uint first = gl_LocalInvocationID.x * each, end = min(first + each, n);
  memoryBarrierBuffer();
  Sum sum = Sum(0u);
  for (uint i = first; i < end; ++i) sum = plus(sum, blocks[i]);
  barrier();
  sum = sum_before(sum);
  for (uint i = first; i < end; ++i) {
    Sum next = plus(sum, blocks[i]);
    blocks[i] = sum;
    sum = next;
  }
}

void sum_all(uint count) {
  uint first = gl_WorkGroupID.x * kScanBlock + kEach * gl_LocalInvocationID.x;
  uvec4 primitives = uvec4(0u);
  Sum mine[kEach], sum = Sum(0u);
  for (uint i = 0u; i < kEach; ++i) {
    mine[i] = sum;
    if (first + i < count) sum = plus(sum, size_of(first + i, primitives));
  }
  if (gl_LocalInvocationID.x < 4u) shown[gl_LocalInvocationID.x] = 0u;
  sum = sum_before(sum);
  for (uint i = 0u; i < kEach; ++i)
    if (first + i < count) offsets[first + i] = plus(sum, mine[i]);
  for (uint kind = 0u; kind < 4u; ++kind)
    if (primitives[kind] > 0u) atomicAdd(shown[kind], primitives[kind]);
  if (gl_LocalInvocationID.x == 0u) {
    blocks[gl_WorkGroupID.x] = whole;
    memoryBarrierBuffer();
    last = atomicAdd(totals.done, 1u) + 1u == gl_NumWorkGroups.x;
  }
  barrier();
  if (gl_LocalInvocationID.x < 4u) atomicAdd(totals.shown[gl_LocalInvocationID.x], shown[gl_LocalInvocationID.x]);
  for (bool ends = last; ends; ends = false) {  // no if: software devices run both sides of one
    sum_blocks();
    if (gl_LocalInvocationID.x == 0u) totals.done = 0u;
    finish(whole);
  }
}

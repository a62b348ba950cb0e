// A histogram of a picture of cell ids.
layout(local_size_x = 16, local_size_y = 16) in;
layout(binding = 1) uniform usampler2D ids;
layout(std430, binding = 2) buffer Counts { uint counts[]; };
layout(location = 0) uniform uvec4 what;  // pixels along each side, ids, the first count

void main() {
  uvec2 at = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(at, what.xx))) return;
  uint id = texelFetch(ids, ivec2(at), 0).r;
  if (id < what.y) atomicAdd(counts[what.z + id], 1u);
}

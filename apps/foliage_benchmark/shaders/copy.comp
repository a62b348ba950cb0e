// As many bytes read, and as many written, as somebody else does.
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer From { uvec4 from[]; };
layout(std430, binding = 1) writeonly buffer To { uvec4 to[]; };
layout(location = 0) uniform uint reads;
layout(location = 1) uniform uint writes;

void main() {
  uint i = gl_WorkGroupID.x * 64u + gl_LocalInvocationID.x;
  uvec4 value = i < reads ? from[i] : uvec4(i);
  if (i < writes) to[i] = value;
  else if (value.x == 0xdeadbeefu) to[0] = value;  // never: what is read must count
}

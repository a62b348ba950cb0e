// Quads as parallel rays see them, of a slab of their plant.
layout(std430, binding = 0) readonly buffer SlabQuads { uint slab_quads[]; };

layout(location = 0) uniform vec3 centre;
layout(location = 2) uniform vec3 right;
layout(location = 3) uniform vec3 up;
layout(location = 4) uniform vec3 towards;
layout(location = 5) uniform float radius;
layout(location = 6) uniform vec2 slab;  // nearness of its front, thickness; metres
layout(location = 7) uniform uint first_leaf;

layout(location = 0) out vec3 out_uv;
layout(location = 1) out vec4 out_normal;  // w: shade
layout(location = 2) flat out float out_leaf;
layout(location = 3) flat out uint out_hash;

void main() {
  const uint corners[6] = uint[](0u, 1u, 2u, 0u, 2u, 3u);
  uint quad = slab_quads[uint(gl_VertexID) / 6u], corner = corners[uint(gl_VertexID) % 6u];
  uvec4 bits = quads[quad].corners[corner];
  bool leaf = quad >= first_leaf;
  vec3 d = uintBitsToFloat(bits.xyz) - centre;
  out_uv = vec3(corner_uv(bits), leaf ? 1.0 : 0.0);
  float shade = float((quads[quad].anchor_shades.w >> (8u * corner)) & 255u) * (1.0 / 255.0);
  out_normal = vec4(unpack_normal(quads[quad].normals[corner]), shade);
  out_leaf = leaf ? 1.0 : 0.0;
  out_hash = mixed(quad);
  gl_Position = vec4(dot(d, right) / radius, dot(d, up) / radius, (slab.x - dot(d, towards)) / slab.y, 1.0);
}

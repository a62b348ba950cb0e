#extension GL_ARB_shader_draw_parameters : require
layout(location = 0) in vec3 position;  // in its block's frame
layout(location = 4) in uint block;

layout(std430, binding = 1) readonly buffer Blocks { vec4 rows[]; };
layout(location = 0) uniform mat4 view_projection;

layout(location = 0) flat out uint id;

void main() {
  uint at = 3u * (block & 0xffffffu);
  vec4 p = vec4(position, 1.0);
  id = uint(gl_BaseInstanceARB);
  gl_Position = view_projection * vec4(dot(rows[at], p), dot(rows[at + 1u], p), dot(rows[at + 2u], p), 1.0);
}

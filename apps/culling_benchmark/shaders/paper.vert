#version 450 core
layout(location = 0) in vec3 position;  // metres
layout(location = 1) in vec4 colour;    // light and shade included
// Where the mesh stands and which way it looks; for what stands in place already: 0, (0, 1), white.
layout(location = 2) in vec3 place;
layout(location = 3) in vec2 forward;
layout(location = 4) in vec4 tint;

layout(location = 0) uniform mat4 view_projection;  // of positions relative to the eye
layout(location = 1) uniform vec3 eye;

layout(location = 0) out vec3 out_colour;

void main() {
  vec3 at = place + vec3(forward.y, -forward.x, 0.0) * position.x + vec3(forward, 0.0) * position.y;
  at.z += position.z;
  out_colour = colour.rgb * tint.rgb;
  gl_Position = view_projection * vec4(at - eye, 1.0);
}

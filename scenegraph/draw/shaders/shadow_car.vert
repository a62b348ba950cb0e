// The dark ground under a car. The instance is the car's.
layout(location = 4) in vec4 row_x;
layout(location = 5) in vec4 row_y;
layout(location = 6) in vec4 row_z;
layout(location = 7) in vec4 extra;

layout(location = 0) out vec2 out_at;
layout(location = 1) flat out vec2 out_kind;  // darkness, squareness

void main() {
  vec2 at = vec2(gl_VertexID == 0 || gl_VertexID == 3 ? -1.0 : 1.0, gl_VertexID < 2 ? -1.0 : 1.0);
  vec4 p = vec4(at * vec2(1.2, 2.55), 0.05, 1.0);
  vec3 rel = vec3(dot(row_x, p), dot(row_y, p), dot(row_z, p));
  out_at = at;
  out_kind = vec2(0.8 * exp2(-length(rel) * frame.fog.x), 1.0);
  // Of a car between two levels one instance is below 0: one shadow is enough.
  gl_Position = extra.w < 0.0 ? vec4(0.0) : frame.view_projection * vec4(rel, 1.0);
}

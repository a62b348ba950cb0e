// One triangle over the whole picture, at infinity.
layout(location = 0) out vec3 out_ray;

void main() {
  vec2 p = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  out_ray = frame.ray_forward.xyz + p.x * frame.ray_right.xyz + p.y * frame.ray_up.xyz;
  gl_Position = vec4(p, 0.0, 1.0);
}

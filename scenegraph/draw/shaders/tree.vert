layout(location = 0) in vec3 position;  // foot at 0, top at z = 1, farthest from the axis at 1
layout(location = 1) in vec4 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in uvec2 shade_leaf;
layout(location = 4) in vec4 row_x;  // the instance: metres relative to the eye
layout(location = 5) in vec4 row_y;
layout(location = 6) in vec4 row_z;
layout(location = 7) in vec4 extra;  // 1 / crown radius, 1 / height, tint, texture layer of the bark

layout(location = 0) out vec3 out_rel;
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec3 out_uv;
layout(location = 3) out vec3 out_shade;  // ambient light that arrives, leaf, tint

void main() {
  vec4 p = vec4(position, 1.0);
  out_rel = vec3(dot(row_x, p), dot(row_y, p), dot(row_z, p));
  vec3 n = normal.xyz * extra.xxy;
  out_normal = vec3(dot(row_x.xyz, n), dot(row_y.xyz, n), dot(row_z.xyz, n));
  float leaf = float(shade_leaf.y);
  out_uv = vec3(uv * 8.0, extra.w + leaf);
  out_shade = vec3(float(shade_leaf.x) * (1.0 / 255.0), leaf, extra.z);
  gl_Position = frame.view_projection * vec4(out_rel, 1.0);
}

layout(location = 0) in vec3 position;  // in the mesh's frame
layout(location = 1) in vec4 normal;
layout(location = 2) in uint colour;  // sRGB
layout(location = 4) in vec4 row_x;
layout(location = 5) in vec4 row_y;
layout(location = 6) in vec4 row_z;
layout(location = 7) in vec4 paint;  // linear; w: how much of it

layout(location = 0) out vec3 out_rel;
layout(location = 1) out vec3 out_normal;
layout(location = 2) flat out vec3 out_albedo;

void main() {
  vec4 p = vec4(position, 1.0);
  out_rel = vec3(dot(row_x, p), dot(row_y, p), dot(row_z, p));
  // By the cofactors: right for any scale, and for a mirror.
  out_normal = vec3(dot(cross(row_y.xyz, row_z.xyz), normal.xyz), dot(cross(row_z.xyz, row_x.xyz), normal.xyz),
                    dot(cross(row_x.xyz, row_y.xyz), normal.xyz));
  vec3 own = from_srgb(vec3(colour & 255u, colour >> 8 & 255u, colour >> 16 & 255u) * (1.0 / 255.0));
  out_albedo = mix(own, paint.rgb, paint.w);
  gl_Position = frame.view_projection * vec4(out_rel, 1.0);
}

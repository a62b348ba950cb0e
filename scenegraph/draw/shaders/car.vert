layout(location = 0) in vec3 position;  // wheels on 0, y forward, metres
layout(location = 1) in vec4 normal;
layout(location = 2) in uint part;
layout(location = 4) in vec4 row_x;
layout(location = 5) in vec4 row_y;
layout(location = 6) in vec4 row_z;
layout(location = 7) in vec4 extra;  // paint, linear; share

layout(location = 0) out vec3 out_rel;
layout(location = 1) out vec3 out_normal;
layout(location = 2) flat out vec4 out_base;  // colour, and how much of a mirror
layout(location = 3) flat out float out_share;

// By CarPart of car_model.h.
const vec4 kParts[6] = vec4[](vec4(0.0), vec4(0.018, 0.022, 0.026, 0.85), vec4(0.012, 0.012, 0.013, 0.05),
                              vec4(0.35, 0.36, 0.38, 0.4), vec4(0.85, 0.85, 0.80, 0.5), vec4(0.42, 0.015, 0.01, 0.4));

void main() {
  vec4 p = vec4(position, 1.0);
  out_rel = vec3(dot(row_x, p), dot(row_y, p), dot(row_z, p));
  out_normal = vec3(dot(row_x.xyz, normal.xyz), dot(row_y.xyz, normal.xyz), dot(row_z.xyz, normal.xyz));
  out_base = part == 0u ? vec4(extra.rgb, 0.45) : kParts[min(part, 5u)];
  out_share = extra.w;
  gl_Position = frame.view_projection * vec4(out_rel, 1.0);
}

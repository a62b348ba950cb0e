// Trees are lit at their vertices: leaves are small, and pixels are many.
layout(location = 0) in vec3 position;  // foot at 0, top at z = 1, farthest from the axis at 1
layout(location = 1) in vec4 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in uvec2 shade_leaf;
layout(location = 4) in vec4 row_x;  // the instance: metres relative to the eye
layout(location = 5) in vec4 row_y;
layout(location = 6) in vec4 row_z;
layout(location = 7) in vec4 extra;  // 1 / crown radius, 1 / height, tint, texture layer of the bark

layout(location = 0) out vec3 out_uv;
layout(location = 1) out vec3 out_light;  // what the texture's colour is multiplied by, and what the air adds
layout(location = 2) out vec3 out_air;

void main() {
  vec4 p = vec4(position, 1.0);
  vec3 rel = vec3(dot(row_x, p), dot(row_y, p), dot(row_z, p));
  vec3 n = normal.xyz * extra.xxy;
  n = normalize(vec3(dot(row_x.xyz, n), dot(row_y.xyz, n), dot(row_z.xyz, n)));
  float shade = float(shade_leaf.x) * (1.0 / 255.0);
  float leaf = float(shade_leaf.y);
  out_uv = vec3(uv * 8.0, extra.w + leaf);

  float towards = dot(n, frame.sun.xyz);
  float lit = max(towards, 0.0) + leaf * (0.16 + 0.22 * max(-towards, 0.0));  // leaves let light through
  float h = 0.5 + 0.5 * dot(n, frame.up.xyz);
  vec3 ambient = mix(frame.ground_light.rgb, frame.sky_light.rgb, h) * (0.3 + 0.7 * shade);
  vec3 light = ambient + frame.sun_light.rgb * (lit * (0.25 + 0.75 * shade * shade));
  light *= mix(vec3(1.0), mix(vec3(0.72, 0.84, 0.80), vec3(1.12, 1.0, 0.72), extra.z), leaf);

  float d = length(rel);
  float clear = exp2(-d * frame.fog.x);
  out_light = light * clear;
  out_air = air_light(rel / d) * (1.0 - clear);
  gl_Position = frame.view_projection * vec4(rel, 1.0);
}

layout(location = 0) in vec3 position;  // in its block's frame
layout(location = 1) in vec4 normal;
layout(location = 2) in uint colour;  // sRGB, material in the top byte
layout(location = 3) in vec2 uv;
layout(location = 4) in uint block;  // lanes of the street in the top byte
layout(location = 5) in float share;  // only of what fades

layout(std430, binding = 1) readonly buffer Blocks { vec4 rows[]; };

layout(location = 0) out vec3 out_rel;
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec2 out_uv;
layout(location = 3) out vec3 out_place;
layout(location = 4) flat out vec3 out_albedo;
layout(location = 5) flat out uvec2 out_kind;  // material, seed; streets: material, lanes; pictures: material, texture
layout(location = 6) flat out float out_share;

void main() {
  uint at = 3u * (block & 0xffffffu);
  vec4 rx = rows[at], ry = rows[at + 1u], rz = rows[at + 2u];
  vec4 p = vec4(position, 1.0);
  out_rel = vec3(dot(rx, p), dot(ry, p), dot(rz, p));
  out_normal = vec3(dot(rx.xyz, normal.xyz), dot(ry.xyz, normal.xyz), dot(rz.xyz, normal.xyz));
  out_uv = uv;
  out_share = share;
  out_place = position;
  vec3 s = vec3(colour & 255u, colour >> 8 & 255u, colour >> 16 & 255u) * (1.0 / 255.0);
  out_albedo = from_srgb(s);
  out_kind = uvec2(colour >> 24, seed_of(colour, block));
  gl_Position = frame.view_projection * vec4(out_rel, 1.0);
}

// Colour as it is, unlit; and the surface as LdmTexel (foliage/ldm_pack.h) has it.
layout(location = 0) in vec3 uv;
layout(location = 1) in vec4 normal;
layout(location = 2) flat in float leaf;
layout(location = 3) flat in uint hash;
layout(location = 0) out vec4 colour;
layout(location = 1) out vec4 surface;

uint tree_samples() { return ~0u; }

layout(binding = 0) uniform sampler2DArray images;

vec2 octahedral(vec3 v) {
  vec3 n = v / (abs(v.x) + abs(v.y) + abs(v.z));
  vec2 sides = mix(vec2(-1.0), vec2(1.0), greaterThanEqual(n.xy, vec2(0.0)));
  return n.z < 0.0 ? (1.0 - abs(n.yx)) * sides : n.xy;
}

void main() {
  vec4 texel = texture(images, uv);
  float alpha = mix(1.0, mix(step(0.5, texel.a), texel.a, blurred(uv.xy, 256.0)), leaf);
  cover(alpha, hash);
  colour = vec4(texel.rgb, 1.0);
  float shade = floor(clamp(normal.w, 0.0, 1.0) * 127.0 + 0.5) + 128.0 * leaf;
  surface = vec4(0.5 + 0.5 * octahedral(normal.xyz), gl_FragCoord.z, shade / 255.0);
}

// A square of pixels that stands for leaves, or wood, of a tree of a grove: as plant_points.vert, without wind, which
// would move it by less than a quarter of what may be wrong. It asks of the host what plant.glsl does.
struct LeafPoint {
  vec4 position_area;
  uvec4 rest;  // normal, sRGB colour and contrast, shade as floatBitsToUint, the tree's hash
};
layout(std430, binding = 1) restrict readonly buffer BlockRows { vec4 block_rows[]; };
layout(std430, binding = 15) readonly buffer GroveItems { GroveItem items[]; };
layout(std430, binding = 16) readonly buffer GroveGroups { uvec2 groups[]; };
layout(std430, binding = 17) readonly buffer Points { LeafPoint points[]; };

layout(location = 0) out vec3 out_colour;
layout(location = 1) flat out uint out_samples;
layout(location = 7) flat out uvec2 out_share;

// Of a round stem of that direction, the mean of two normals that lean to its sides so far that light from the eye is as
// on average over its width, pi / 4; and how unlike that both are.
void stem_light(vec3 rel, vec3 along, float shade, float tint, out vec3 light, out vec3 unlike, out vec3 air) {
  vec3 side = cross(along, rel), other;
  side /= max(length(side), 1e-20);
  const float kTowards = 0.785398, kLean = 0.618987;
  vec3 towards = kTowards * faceforward(cross(side, along), rel, cross(side, along));
  plant_light(rel, towards + kLean * side, shade, 0.0, tint, light, air);
  plant_light(rel, towards - kLean * side, shade, 0.0, tint, other, air);
  unlike = 0.5 * (light - other);
  light = 0.5 * (light + other);
}

void main() {
  uint slot = uint(gl_VertexID);
  uvec2 group = groups[slot / kGroveGroup];
  GroveItem item = items[group.x];
  uint rank = group.y + slot % kGroveGroup;
  out_colour = vec3(0.0);
  out_samples = 0u;
  out_share = uvec2(0u);
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // outside of every picture
  gl_PointSize = 1.0;
  if (rank >= item.count) return;
  LeafPoint point = points[item.first + rank];
  vec4 x = block_rows[3u * item.block], y = block_rows[3u * item.block + 1u], z = block_rows[3u * item.block + 2u];
  vec4 p = vec4(point.position_area.xyz, 1.0);
  vec3 rel = vec3(dot(x, p), dot(y, p), dot(z, p)), of_block = unpack_normal(point.rest.x);
  gl_Position = clip_position(rel);
  float pixels = point.position_area.w * item.scale * facing_pixels(rel, depth_of(rel, gl_Position));
  pixels *= clamp((item.edge - float(rank)) / item.fade, 0.0, 1.0);
  // Less than a pixel is drawn as a part of one: the same samples of all pixels that it touches, so that it covers as
  // many as it should wherever it lies.
  uint hash = mixed(point.rest.w + rank);
  out_samples = samples_of(min(pixels, 1.0), noise_of(hash), hash);
  out_share = uvec2(point.rest.w, item.share);
  vec3 n = normalize(vec3(dot(x.xyz, of_block), dot(y.xyz, of_block), dot(z.xyz, of_block))), light, unlike, air;
  float tint = float(point.rest.w & 255u) * (1.0 / 255.0), shade = uintBitsToFloat(point.rest.z);
  if ((point.rest.x & kGroveLeaf) != 0u) {
    plant_light(rel, n, shade, 1.0, tint, light, air);
    unlike = light * (float(point.rest.y >> 24u) * (1.0 / 255.0));
  } else {
    stem_light(rel, n, shade, tint, light, unlike, air);
  }
  vec3 srgb = vec3(point.rest.y & 255u, (point.rest.y >> 8u) & 255u, (point.rest.y >> 16u) & 255u) * (1.0 / 255.0);
  vec3 albedo = plant_albedo(srgb) * item.light, mean = albedo * light, off = albedo * unlike;
  out_colour = 0.5 * (plant_film(mean + off + air) + plant_film(mean - off + air));
  gl_PointSize = sqrt(max(pixels, 1.0));
}

// As PlantQuad of foliage/prepared_plant.h.
struct PlantQuad {
  uvec4 corners[4];  // position, u and v
  uvec4 normals;
  uvec4 anchor_shades;
};
layout(std430, binding = 17) readonly buffer Quads { PlantQuad quads[]; };

vec2 corner_uv(uvec4 corner) { return vec2(corner.w & 0xffffu, corner.w >> 16u) * (8.0 / 65535.0); }

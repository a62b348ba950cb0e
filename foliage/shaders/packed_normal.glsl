// What pack_normal() of foliage/plant_mesh.h packs.
vec3 unpack_normal(uint bits) {
  ivec3 v = ivec3(int(bits << 22u) >> 22, int(bits << 12u) >> 22, int(bits << 2u) >> 22);
  return vec3(v) * (1.0 / 511.0);
}

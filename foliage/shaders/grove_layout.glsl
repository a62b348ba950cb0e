// What drawing groves reads, as std430 lays it out; compiled as C++ too (foliage/gl/draw_groves.h).
struct GroveItem {
  uint block;         // whose rows place it
  uint first, count;  // points
  uint share;         // 255ths of it that its trees show themselves
  float edge, fade, scale, light;  // GroveShown
};
const uint kGroveGroup = 16u;  // points of one item
const uint kGroveLeaf = 1u << 30u;  // beside a point's normal: it is of a leaf, not of wood

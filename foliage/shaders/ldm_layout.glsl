// What drawing packs of mosaics reads, as std430 lays it out; compiled as C++ too (foliage/ldm_select.h).

// A tree in view: p -> dot(row, vec4(p, 1)), from the plant's frame, metres, relative to the eye.
struct LdmTree {
  vec4 row_x, row_y, row_z;
  vec3 to_eye;  // unit, from the pack's middle, in the plant's frame; 0: mosaics do not turn to it
  uint hash;
};

// Mosaics [.., last) of a side of a tree. Of each pixel's numbers in [0, 1) those in [low, high) show it.
struct LdmItem {
  uint tree, side, last, spare;
  float low, high;
  float grown;  // foliage/shaders/ldm_turn.glsl
  float spare0;
};

// A side of a pack. A place in it: origin + x right + y up + depth inward; x and y in pixels of its pictures, depth in
// 65535ths.
struct LdmSideHead {
  vec4 origin, right, up, inward;
  uint first_block, first_page;
  uint number;  // of its pack: what is random about it must not depend on which packs there are besides
  float height;  // of the plant, by which wind moves it; 0: it stands still
};

const uint kLdmGroup = 1u;  // mosaics of one item, drawn together: the farthest trees have one a side

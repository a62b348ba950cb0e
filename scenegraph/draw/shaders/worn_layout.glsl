// How a picture is worn, and where it is held; compiled as C++ too (picture_pages.h).
struct WornData {
  vec4 place;  // in its page, whose edges are 0 and 1: xy: lower left corner, z: side; w: levels above the finest
  vec4 part;   // of the picture: xy: lower left corner; zw: of how many such parts it is as wide and as high
  uvec4 how;   // x: page + 1, 0: it is not held; y: manzana::Wrap; z: colour beyond its edges
};

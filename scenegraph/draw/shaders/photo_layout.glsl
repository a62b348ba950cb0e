// Of the ground's photo; compiled as C++ too (photo_layer.h). Squares are those of the finest level that is drawn.
struct PhotoData {
  vec4 place;    // xy: the eye; z: squares a metre; w: how many levels are windows
  vec4 size;     // xy: of the photo; z: side of a window, in its own squares
  vec4 held[8];  // of each window: what it holds, low and high, in its own squares
};

// Before a host's fragment shader: it goes on in mask_end.glsl.
#define main shade

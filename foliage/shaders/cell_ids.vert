// Quads as parallel rays see them, in one picture; or each cell apart, moved to a tile of its own.
layout(std430, binding = 0) readonly buffer CellOfQuads { uint cell_of[]; };
struct Tile {
  ivec4 box;   // pixels [xy, zw) of the picture of tiles
  ivec4 move;  // xy: from the view's pixels to those
};
layout(std430, binding = 1) readonly buffer Tiles { Tile tiles[]; };

layout(location = 0) uniform vec3 centre;
layout(location = 1) uniform vec3 right;
layout(location = 2) uniform vec3 up;
layout(location = 3) uniform vec3 towards;
layout(location = 4) uniform vec2 scale_radius;  // pixels a metre; metres before and behind the centre
layout(location = 5) uniform ivec2 pixels;       // along a side: of the view, of what is drawn into
layout(location = 6) uniform bool apart;

layout(location = 0) out vec2 out_uv;
layout(location = 1) flat out uint out_cell;
layout(location = 2) flat out ivec4 out_box;

invariant gl_Position;  // the same depth in every pass

void main() {
  const uint corners[6] = uint[](0u, 1u, 2u, 0u, 2u, 3u);
  uint quad = uint(gl_VertexID) / 6u;
  uvec4 bits = quads[quad].corners[corners[uint(gl_VertexID) % 6u]];
  vec3 d = uintBitsToFloat(bits.xyz) - centre;
  vec2 at = vec2(dot(d, right), dot(d, up)) * scale_radius.x + 0.5 * float(pixels.x);
  out_uv = corner_uv(bits);
  out_cell = cell_of[quad];
  out_box = ivec4(0, 0, pixels.x, pixels.x);
  if (apart) {
    out_box = tiles[out_cell].box;
    at += vec2(tiles[out_cell].move.xy);
  }
  gl_Position = vec4(at * (2.0 / float(pixels.y)) - 1.0, 0.5 - 0.5 * dot(d, towards) / scale_radius.y, 1.0);
}

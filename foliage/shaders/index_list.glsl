// One tree's leaves as a list of indices, by two passes:
//   index_count  a cell and its level of detail -> how many leaves it keeps, and where they begin in the list
//   index_write  a leaf that is kept -> its indices
layout(local_size_x = 256) in;
layout(std430, binding = 4) restrict readonly buffer Cells { CellHead cells[]; };
layout(std430, binding = 5) restrict readonly buffer Lods { float lods[]; };       // a row a cell of the plant's
layout(std430, binding = 10) restrict buffer Offsets { uint offsets[]; };          // in leaves; a row a cell
layout(std430, binding = 12) restrict buffer Command { uint draw[5]; uint spare[3]; uint dispatch[3]; };
layout(std430, binding = 16) restrict writeonly buffer Indices { uint indices[]; };
layout(location = 0) uniform uint first_cell;
layout(location = 1) uniform uint cell_count;
layout(location = 2) uniform uint first_quad;
const uint kIndices = 6u;  // of a quad

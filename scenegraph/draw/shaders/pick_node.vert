layout(location = 0) in vec3 position;
layout(location = 4) in vec4 row_x;
layout(location = 5) in vec4 row_y;
layout(location = 6) in vec4 row_z;
layout(location = 7) in vec4 number;  // its halves, 16 bits each

layout(location = 0) uniform mat4 view_projection;
layout(location = 0) flat out uint id;

void main() {
  vec4 p = vec4(position, 1.0);
  id = uint(number.x) | uint(number.y) << 16;
  gl_Position = view_projection * vec4(dot(row_x, p), dot(row_y, p), dot(row_z, p), 1.0);
}

layout(location = 0) in vec3 position;  // relative to the eye
layout(location = 1) in vec3 line_colour;
layout(location = 0) out vec3 out_colour;

void main() {
  out_colour = line_colour;
  gl_Position = frame.view_projection * vec4(position, 1.0);
}

layout(location = 0) in vec3 shown;
layout(location = 1) flat in uint own_samples;
layout(location = 0) out vec4 colour;

void main() {
  cover(own_samples);
  colour = vec4(shown, 1.0);
}

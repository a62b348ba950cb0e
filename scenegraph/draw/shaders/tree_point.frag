layout(location = 0) in vec3 shown;
layout(location = 0) out vec4 colour;

void main() { colour = vec4(shown, 1.0); }

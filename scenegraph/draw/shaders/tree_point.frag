layout(location = 0) in vec3 shown;
layout(location = 1) flat in float alpha;
layout(location = 2) flat in uint hash;
layout(location = 0) out vec4 colour;

void main() {
  cover(alpha, hash);
  colour = vec4(shown, 1.0);
}

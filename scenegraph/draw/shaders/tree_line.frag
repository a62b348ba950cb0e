layout(location = 0) in vec4 light;  // times the bark's colour; alpha: true width over the drawn one
layout(location = 1) in vec3 air;
layout(location = 2) flat in uint hash;
layout(location = 0) out vec4 colour;

void main() {
  cover(light.a, hash);
  colour = vec4(film(light.rgb + air), 1.0);
}

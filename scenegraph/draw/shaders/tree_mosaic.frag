layout(location = 0) out vec4 colour;

void main() {
  Mosaic m = mosaic();
  vec3 light, air;
  plant_light(m.rel, m.normal, m.shade, m.leaf, m.tint, light, air);
  colour = vec4(film(from_srgb(m.albedo) * light + air), 1.0) * m.weight;
}

// What a host puts there: seen from both sides, without gloss.
layout(location = 0) in vec3 rel;
layout(location = 1) in vec3 smooth_normal;
layout(location = 2) flat in vec3 albedo;
layout(location = 0) out vec4 colour;

void main() {
  vec3 n = normalize(smooth_normal);
  n = dot(n, rel) > 0.0 ? -n : n;
  colour = picture(albedo * diffuse_light(n, 1.0), rel);
}

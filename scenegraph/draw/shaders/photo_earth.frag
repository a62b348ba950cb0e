// Of the Earth's own ground what the photo shows, where a host has the rest.
layout(location = 0) in vec3 ray;
layout(location = 0) out vec4 colour;

void main() {
  vec3 d = normalize(ray);
  float t = earth_distance(d);
  vec4 seen = photo_seen(d.xy * t);
  if (seen.a <= 0.0) discard;
  vec3 ground = seen.rgb / seen.a * diffuse_light(frame.up.xyz, 0.9);
  colour = vec4(film(mix(air_light(d), ground, exp2(-t * frame.fog.x))), 1.0) * seen.a;
}

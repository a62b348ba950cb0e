// Water: the sky mirrored on a few standing ripples.
void main() {
  vec2 p = place.xy;
  float far = smoothstep(0.1, 1.2, fwidth(p.x) + fwidth(p.y));
  vec2 slope = vec2(cos(p.x * 1.9 + 1.3 * sin(p.y * 0.83)), cos(p.y * 1.7 + 1.1 * sin(p.x * 0.71 + 2.0))) * 0.035 +
               vec2(cos(dot(p, vec2(4.1, 3.3))), cos(dot(p, vec2(-3.1, 4.7)))) * 0.02;
  vec3 n = normalize(frame.up.xyz + vec3(slope * (1.0 - far), 0.0));
  vec3 d = normalize(rel);
  float facing = clamp(-dot(d, n), 0.0, 1.0);
  float miss = 1.0 - facing;
  float fresnel = 0.03 + 0.97 * miss * miss * miss * miss * miss;
  vec3 mirrored = reflect(d, n);
  vec3 deep = photographed(albedo * 0.35, on_ground()) * diffuse_light(frame.up.xyz, 1.0);
  float glint = pow(max(dot(mirrored, frame.sun.xyz), 0.0), 180.0);
  colour = picture(mix(deep, sky_light(mirrored), fresnel) + frame.sun_light.rgb * glint, rel);
}

// Asphalt with lane lines: uv = metres along, lanes from the left edge; dashes between lanes, and lines along the edges
// of streets with more than two lanes. Junctions have none.
void main() {
  vec2 w = max(fwidth(uv), 1e-5);
  float street = kind.x == 2u ? 1.0 : 0.0;
  float lanes = float(kind.y & 255u) * street;
  float line = floor(uv.y + 0.5);
  float inner = (line > 0.5 && line < lanes - 0.5) ? 1.0 : 0.0;
  float edge = (1.0 - inner) * (lanes > 2.5 ? 1.0 : 0.0);
  float off = uv.y - line;
  float inset = line < 0.5 ? off - 0.09 : off + 0.09;
  float across = mix(cover(inset, w.y, -0.02, 0.02), cover(off, w.y, -0.02, 0.02), inner);
  float dash = uv.x * (1.0 / 9.0);
  float along = mix(cover(fract(dash), w.x * (1.0 / 9.0), 0.0, 0.34), 0.34, smoothstep(0.2, 0.5, w.x * (1.0 / 9.0)));
  float paint = across * mix(edge, along, inner) * street * (1.0 - smoothstep(0.3, 0.6, w.y));

  float worn = value_noise(place.xy * 0.23);
  float fine = (1.0 - smoothstep(0.03, 0.15, fwidth(place.x) + fwidth(place.y))) * (value_noise(place.xy * 23.0) - 0.5);
  vec3 base = albedo * (0.86 + 0.22 * worn + 0.20 * fine);
  base = mix(base, vec3(0.62), paint * (0.75 + 0.2 * worn));
  base = photographed(base, on_ground());
  colour = picture(base * diffuse_light(normalize(smooth_normal), 0.85), rel);
}

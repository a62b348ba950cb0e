// Sun, sky, air and film: what every surface has in common.

// The air's light from direction d, unit: bluish, warm towards the sun.
vec3 air_light(vec3 d) {
  float c = max(dot(d, frame.sun.xyz), 0.0);
  float c2 = c * c;
  return frame.horizon.rgb + frame.sun_light.rgb * (0.14 * c2 * c2 * c2);
}

// The clear sky in direction d, unit, without the sun itself.
vec3 sky_light(vec3 d) {
  float e = clamp(dot(d, frame.up.xyz), 0.0, 1.0);
  return mix(frame.zenith.rgb, air_light(d), exp2(-5.5 * e));
}

// Diffuse light on a surface of that normal, for an albedo of one. `open`: how much of the sky it sees.
vec3 diffuse_light(vec3 n, float open) {
  float h = 0.5 + 0.5 * dot(n, frame.up.xyz);
  vec3 ambient = mix(frame.ground_light.rgb, frame.sky_light.rgb, h) * open;
  return ambient + frame.sun_light.rgb * max(dot(n, frame.sun.xyz), 0.0);
}

// A fit of the ACES film curve, less exposed than the original.  [Narkowicz 2015, "ACES Filmic Tone Mapping Curve"]
vec3 film(vec3 x) {
  x *= 0.62;
  return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

// Within 0.001 of the exact curve.
vec3 from_srgb(vec3 s) { return s * (s * (s * 0.305306011 + 0.682171111) + 0.012522878); }

// Through the air to the eye, onto the film. rel: the surface, relative to the eye.
vec4 picture(vec3 colour, vec3 rel) {
  float d = length(rel);
  return vec4(film(mix(air_light(rel / d), colour, exp2(-d * frame.fog.x))), 1.0);
}
